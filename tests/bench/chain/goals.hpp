#pragma once

#include <string>
#include <vector>

#include "tests/bench/chain/table.hpp"

namespace trivela::bench {

/// The chains, by the names that rows have.
inline constexpr const char* kUdp = "UDP, 4 processes";
inline constexpr const char* kBare = "Cyclone, 4 processes";
inline constexpr const char* kBareOne = "Cyclone, one process";
inline constexpr const char* kListener = "DDS listener, 4 processes";
inline constexpr const char* kSecured = "DDS listener secured";
inline constexpr const char* kOne = "DDS listener, one process";

/// What the rows of a run miss, a sentence each: without load at the median at most 1.1 x bare Cyclone (over processes
/// and in one), 1.5 x UDP over processes, secured 1.5 x plain; with SCHED_FIFO at the 99th percentile under load at
/// most 1.5 x without. Ratios within a condition of a run, since those between runs move with the machine.
std::vector<std::string> missed_goals(const std::vector<Row>& rows);

}  // namespace trivela::bench
