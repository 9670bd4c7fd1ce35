#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/faults/schedule.hpp"
#include "tests/faults/stack.hpp"

namespace trivela::faults {

/// A fault that was made, and what it took until the chain was whole again.
struct Trial {
  Fault fault;
  std::int64_t began_ns = 0;  ///< CLOCK_MONOTONIC
  std::int64_t ended_ns = 0;  ///< the node runs again, the link is sound again
  std::int64_t whole_ns = 0;  ///< the chain is whole again, or was started again
  bool recovered = false;
  double streams_s = 0.0;              ///< from ended_ns until every periodic topic was heard again
  double kick_s = 0.0;                 ///< ... and until a new order was fired
  std::string complaint;               ///< what should not have been, e.g. who ended by itself; empty: nothing
  std::vector<std::string> crashed{};  ///< nodes that a signal ended while packets were garbled, in words
};

/// How a campaign is watched and ended.
struct Watch {
  double limit_s = 30.0;                                         ///< to be whole again
  std::function<void(std::size_t done, const Fault&)> progress;  ///< before each fault
  std::function<void()> look;                                    ///< every 20 ms; may throw to end the campaign
};

/// Makes one fault after the other and waits each time until the chain is whole: every periodic topic is heard, a new
/// order is fired, the recorder writes, and where the observer was hit, an outcome is told. A chain that does not come
/// back within the limit is started again; where it does not even then, the campaign ends there. Throws
/// std::runtime_error if it does not start at first.
std::vector<Trial> run_campaign(Stack& stack, const std::vector<Fault>& faults, const Watch& watch);

}  // namespace trivela::faults
