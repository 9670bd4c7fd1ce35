#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "monitor/network/readings.hpp"

namespace trivela::monitor::network {

enum class Verdict { kOk, kWarn, kBad };

/// One check: what was found, and what to do about it, unless all is well.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::kOk;
  std::string value;
  std::string advice;
};

/// Each check once, always in the same order.
std::vector<Finding> findings_of(const Readings& readings);

/// The rules of a ruleset, as `nft list ruleset` prints it, that may swallow datagrams to these ports.
std::vector<std::string> swallowing_rules(std::string_view ruleset, Ports ports);

}  // namespace trivela::monitor::network
