#include "evaluator/sessions/session_setup.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

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

SessionSetup SetupIndex::of(const std::string& config) {
  const auto number = [](Numbers& numbers, const std::string& text) {
    return numbers.try_emplace(text, static_cast<std::uint32_t>(numbers.size())).first->second;
  };
  const auto scenario = std::min(config.find(kScenario), config.size());
  return {number(worlds_, config.substr(scenario)),
          number(settings_, without_who_is_in_charge(config.substr(0, scenario)))};
}

LoggedPitch pitch_of(std::string_view config) {
  LoggedPitch pitch;
  const std::map<std::string, double*, std::less<>> keys{{"[goal]y_m", &pitch.goal.y_m},
                                                         {"[goal]half_width_m", &pitch.goal.half_width_m},
                                                         {"[goal]height_m", &pitch.goal.height_m},
                                                         {"[goal]post_width_m", &pitch.goal.post_width_m},
                                                         {"[field]side_line_x_m", &pitch.side_line_x_m}};
  std::string table;
  while (!config.empty()) {
    const std::string_view line = config.substr(0, config.find('\n'));
    config.remove_prefix(std::min(line.size() + 1, config.size()));
    if (line.starts_with("### ") && !line.starts_with("### settings")) break;  // robots, a scenario
    if (line.starts_with("[")) table = line;
    const auto sign = line.find(" = ");
    if (sign == std::string_view::npos) continue;
    const auto key = keys.find(table + std::string(line.substr(0, sign)));
    if (key == keys.end()) continue;
    const std::string_view value = line.substr(sign + 3);
    std::from_chars(value.data(), value.data() + value.size(), *key->second);
  }
  return pitch;
}

}  // namespace trivela::evaluator
