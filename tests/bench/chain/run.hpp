#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/chain/table.hpp"

namespace trivela::bench {

struct Plan {
  std::int64_t samples = 1000;  // a row
  std::vector<int> rates_hz = {100, 1000};
};

/// Runs all contenders under all conditions, the contenders of one condition in turns of short batches, and prints a
/// row as soon as it is complete. Without permission for SCHED_FIFO those rows are left out and standard error says so.
std::vector<Row> run(const Plan& plan);

/// The same for what might make the chain faster, each option alone and all together, without load; the ratio beside a
/// row is to the chain as it is.
std::vector<Row> run_tries(const Plan& plan);

/// The same for what DDS Security may protect, over four processes; the ratio beside a row is to the plain chain.
std::vector<Row> run_protections(const Plan& plan);

}  // namespace trivela::bench
