#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "config/arms.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"
#include "experiment/study/studies.hpp"

namespace trivela::experiment {
namespace {

/// Is it a setting of the policies?
bool is_setting(const std::string& key) { return key.starts_with("policy."); }

/// As TOML has it: a number, or a law's name in quotes. Throws config::Error where the key has neither.
std::string toml_value_of(const Inputs& inputs, const std::string& key) {
  const auto values =
      is_setting(key) ? config::setting_values(inputs.settings) : config::scenario_values(inputs.scenario);
  const auto found = values.find(key);
  const bool holds = found != values.end() && (found->second.starts_with('"') ||
                                               found->second.find_first_not_of("+-.0123456789e") == std::string::npos);
  if (!holds)
    throw config::Error{
        fmt::format("\"{}\" is no number of a {}", key, is_setting(key) ? "policy's settings" : "scenario")};
  return found->second;
}

UncertainInput input_in(const config::Row& row) {
  UncertainInput input{row.word("key").value_or(""), row.word("low").value_or(""), row.word("high").value_or(""),
                       row.word("why").value_or("")};
  if (!toml_value_of({}, input.key).starts_with('"')) {
    const double low = row.number("low"), high = row.number("high");
    if (!(low < high)) throw std::invalid_argument{"low is not below high"};
    input.low = fmt::format("{}", low);
    input.high = fmt::format("{}", high);
  }
  if (is_setting(input.key))
    for (const std::string& end : {input.low, input.high}) with({}, input.key, end);
  return input;
}

}  // namespace

std::vector<UncertainInput> load_inputs(const std::string& path) {
  std::vector<UncertainInput> inputs;
  config::each_row(path, [&](const config::Row& row) { inputs.push_back(input_in(row)); });
  if (inputs.empty()) throw config::Error{fmt::format("{}: names no input (key,low,high,why)", path)};
  return inputs;
}

bool in_force(const sim::Scenario& scenario, const UncertainInput& input) {
  const std::string& key = input.key;
  if (key.starts_with("keeper.") || key.starts_with("policy.keeper.")) return scenario.keeper.enabled;
  return !key.starts_with("defenders.") || scenario.defenders.count > 0.0;
}

std::string value_of(const Inputs& inputs, const std::string& key) {
  const std::string value = toml_value_of(inputs, key);
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : fmt::format("{:g}", std::stod(value));
}

Inputs with(Inputs inputs, const std::string& key, const std::string& value) {
  const bool text = toml_value_of(inputs, key).starts_with('"');
  const std::string line = text ? fmt::format("{} = \"{}\"", key, value) : fmt::format("{} = {}", key, value);
  if (is_setting(key)) {
    config::override_setting(inputs.settings, {line, "input"});
  } else {
    config::override_scenario(inputs.scenario, line, "input");
  }
  return inputs;
}

}  // namespace trivela::experiment
