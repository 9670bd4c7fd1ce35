#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/faults/campaign.hpp"
#include "tests/faults/fire_rules.hpp"
#include "tests/faults/kick_logs.hpp"

namespace trivela::faults {

/// What a campaign has shown.
struct Verdict {
  std::uint64_t seed = 0;
  std::vector<Trial> trials;
  std::size_t orders = 0;  ///< that the wire's witness saw
  std::vector<FireSeen> fires;
  std::vector<Finding> findings;
  std::vector<Finding> forged;  ///< fires for an order that the wire had forged: told, not counted
  LoggedKicks logged;
  std::vector<std::string> unreadable;  ///< logs that cannot be read
  HubCounts frames;
  double took_s = 0.0;

  /// No fire that should not have been, none lost, every fault recovered from in time, nothing to complain of.
  bool clean() const;
};

/// In how many seconds after the fault's end every periodic topic has to be heard again: 2; after forged packets 4, in
/// which a reader that they made deaf is made again (docs/decisions/0017-mutated-packets.md).
double time_for_streams_s(const Fault& fault);

/// Median and worst of times, NaN where there are none.
struct Times {
  double median_s = 0.0;
  double worst_s = 0.0;
};
Times times_of(std::vector<double> values_s);

/// The table that a campaign ends with.
std::string text(const Verdict& verdict);

nlohmann::json json(const Verdict& verdict);

}  // namespace trivela::faults
