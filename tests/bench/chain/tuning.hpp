#pragma once

#include <string>
#include <vector>

#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

/// What a process asks of the machine before it joins the bus.
struct Tuning {
  bool awake = false;      ///< /dev/cpu_dma_latency held at 0
  bool scheduled = false;  ///< SCHED_FIFO
  bool pinned = false;     ///< on the last processor that it may use
  bool locked = false;     ///< memory locked, and what is freed kept
  bool huge = false;       ///< huge pages for heap and data, where the kernel gives them
};

/// The processes, each tuned first. One that was refused what it asked says so on standard error and goes on.
std::vector<Contender::Process> tuned(const Tuning& tuning, const std::vector<Contender::Process>& processes);

/// Whether a writer of this Cyclone lends memory for its samples, as a sentence.
std::string about_loans();

}  // namespace trivela::bench
