#include "evaluator/report/session_setup.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace trivela::evaluator {
namespace {

constexpr std::string_view kScenario = "\n### scenario\n";
constexpr std::array<std::string_view, 7> kInCharge{
    "policy_by_half = ",  "policy_by_robot = ", "random = ",      "random_probabilities = ",
    "assignment_seed = ", "shadows = ",         "half_minutes = "};

std::string without_who_is_in_charge(const std::string& settings) {
  std::istringstream lines{settings};
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    const auto begins = [&](std::string_view key) { return line.starts_with(key); };
    if (std::ranges::none_of(kInCharge, begins)) rest += line + "\n";
  }
  return rest;
}

}  // namespace

SessionSetup SetupBook::of(const std::string& config) {
  const auto number = [](Numbers& numbers, const std::string& text) {
    return numbers.try_emplace(text, static_cast<std::uint32_t>(numbers.size())).first->second;
  };
  const auto scenario = std::min(config.find(kScenario), config.size());
  return {number(worlds_, config.substr(scenario)),
          number(settings_, without_who_is_in_charge(config.substr(0, scenario)))};
}

}  // namespace trivela::evaluator
