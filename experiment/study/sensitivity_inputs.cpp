#include <fmt/format.h>

#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>

#include "config/arms.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "experiment/study/sensitivity.hpp"

namespace trivela::experiment {
namespace {

bool is_text(const std::string& toml) { return toml.starts_with('"'); }

/// A law's name without its quotes, or a number as people write it.
std::string value_in(const std::map<std::string, std::string>& values, const std::string& key) {
  const auto found = values.find(key);
  if (found != values.end() && is_text(found->second)) return found->second.substr(1, found->second.size() - 2);
  const bool number = found != values.end() && found->second.find_first_not_of("+-.0123456789e") == std::string::npos;
  if (!number)
    throw config::Error{
        fmt::format("\"{}\" is no number of a {}", key, is_setting(key) ? "policy's settings" : "scenario")};
  return fmt::format("{:g}", std::stod(found->second));
}

/// "policy.settle_s = 0.2" as TOML, where the key has such a value now.
std::string line_of(const std::map<std::string, std::string>& values, const std::string& key,
                    const std::string& value) {
  value_in(values, key);
  return is_text(values.at(key)) ? fmt::format("{} = \"{}\"", key, value) : fmt::format("{} = {}", key, value);
}

UncertainInput input_in(const config::Row& row) {
  UncertainInput input{row.word("key").value_or(""), row.word("low").value_or(""), row.word("high").value_or(""),
                       row.word("why").value_or("")};
  const auto values = is_setting(input.key) ? config::setting_values({}) : config::scenario_values({});
  value_in(values, input.key);
  if (!is_text(values.at(input.key))) {
    const double low = row.number("low"), high = row.number("high");
    if (!(low < high)) throw std::invalid_argument{"low is not below high"};
    input.low = fmt::format("{}", low);
    input.high = fmt::format("{}", high);
  }
  if (is_setting(input.key))
    for (const std::string& end : {input.low, input.high}) with(config::Settings{}, input.key, end);
  return input;
}

}  // namespace

std::vector<UncertainInput> load_inputs(const std::string& path) {
  std::ifstream in = config::open_file(path);
  config::CsvReader reader{in, path};
  const auto header = reader.next();
  std::vector<UncertainInput> inputs;
  while (const auto record = header ? reader.next() : std::nullopt) {
    try {
      config::check_width(header->cells, *record);
      inputs.push_back(input_in(config::Row{header->cells, record->cells}));
    } catch (const std::exception& error) {
      throw config::Error{fmt::format("{}:{}: {}", path, record->line, error.what())};
    }
  }
  if (inputs.empty()) throw config::Error{fmt::format("{}: names no input (key,low,high,why)", path)};
  return inputs;
}

bool is_setting(std::string_view key) { return key.starts_with("policy."); }

bool in_force(const sim::Scenario& scenario, const UncertainInput& input) {
  const std::string& key = input.key;
  if (key.starts_with("keeper.") || key.starts_with("policy.keeper.")) return scenario.keeper.enabled;
  return !key.starts_with("defenders.") || scenario.defenders.count > 0.0;
}

std::string value_of(const sim::Scenario& scenario, const std::string& key) {
  return value_in(config::scenario_values(scenario), key);
}

std::string value_of(const config::Settings& settings, const std::string& key) {
  return value_in(config::setting_values(settings), key);
}

sim::Scenario with(sim::Scenario scenario, const std::string& key, const std::string& value) {
  config::override_scenario(scenario, line_of(config::scenario_values(scenario), key, value), "input");
  return scenario;
}

config::Settings with(config::Settings settings, const std::string& key, const std::string& value) {
  const std::string line = line_of(config::setting_values(settings), key, value);
  config::override_setting(settings, {line, "input"});
  return settings;
}

}  // namespace trivela::experiment
