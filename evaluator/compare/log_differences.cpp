#include "evaluator/compare/log_differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "evaluator/compare/policy_comparison.hpp"
#include "kicking/text/printable.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {
namespace {

using PartAndKey = std::pair<std::string, std::string>;
using ValuesOfKeys = std::map<PartAndKey, std::set<std::string>>;

constexpr std::size_t kMostValues = 3;

// The keys of a configuration as table texts has it: parts "### settings", TOML tables, a value a line.
void add_keys(ValuesOfKeys& values, const std::string& config) {
  std::istringstream lines(config);
  std::string part, table;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("### ")) {
      part = line.substr(4);
      table.clear();
    } else if (line.starts_with("[") && line.ends_with("]")) {
      table = line.substr(1, line.size() - 2) + ".";
    } else if (!part.empty() && equals != std::string::npos) {
      values[{part, table + line.substr(0, equals)}].insert(line.substr(equals + 3));
    }
  }
}

ValuesOfKeys values_of(const std::filesystem::path& path) {
  const log::Reader reader(path, log::Check::kSchema);  // who counts its kicks looks closer
  ValuesOfKeys values;
  reader.query("SELECT text FROM texts WHERE sha256 IN (SELECT config_sha256 FROM sessions)",
               [&](const std::string& config) { add_keys(values, config); });
  const auto add = [&](const char* key, const std::string& sql) {
    reader.query(sql, [&](std::optional<std::string> value) {
      if (value) values[{"sessions", key}].insert(*value);
    });
  };
  add("version", "SELECT DISTINCT software_version FROM sessions");
  add("messages (SHA-256)", "SELECT DISTINCT substr(idl_sha256, 1, 12) FROM sessions");
  add("scenario", "SELECT DISTINCT scenario FROM sessions");
  add("simulated", "SELECT DISTINCT CASE simulated WHEN 1 THEN 'yes' ELSE 'no' END FROM sessions");
  add("seed", "SELECT DISTINCT CAST(seed AS TEXT) FROM sessions");
  add("arm", "SELECT DISTINCT arm FROM sessions");
  add("table", "SELECT DISTINCT kicker_table FROM sessions");
  add("policy", "SELECT DISTINCT policy FROM session_policies");
  add("recording robot", "SELECT DISTINCT CAST(robot_id AS TEXT) FROM sessions");
  return values;
}

// Sessions first, settings before robots and the world.
int place_of_part(const std::string& part) { return part == "sessions" ? 0 : part == "settings" ? 1 : 2; }

}  // namespace

std::string shown_values(const std::vector<std::string>& values) {
  if (values.empty()) return "none";
  const auto first = std::span(values).first(std::min(values.size(), kMostValues));
  return fmt::format("{}{}", fmt::join(first, ", "),
                     values.size() > kMostValues ? fmt::format(" and {} more", values.size() - kMostValues) : "");
}

std::vector<LogDifference> log_differences(std::span<const std::filesystem::path> logs) {
  std::vector<ValuesOfKeys> of_logs;
  std::set<PartAndKey> keys;
  for (const std::filesystem::path& path : logs) {
    of_logs.push_back(values_of(path));
    for (const auto& [key, values] : of_logs.back()) keys.insert(key);
  }
  std::vector<LogDifference> differences;
  for (const PartAndKey& key : keys) {
    LogDifference difference{key.first, key.second, {}};
    for (ValuesOfKeys& values : of_logs) {
      const std::set<std::string>& of_key = values[key];
      difference.values.emplace_back(of_key.begin(), of_key.end());
    }
    const auto& first = difference.values.front();
    if (std::ranges::any_of(difference.values, [&](const auto& other) { return other != first; }))
      differences.push_back(std::move(difference));
  }
  std::ranges::stable_sort(differences, {}, [](const LogDifference& of) { return place_of_part(of.part); });
  return differences;
}

std::string differences_text(const std::vector<LogDifference>& differences, std::span<const std::string> logs,
                             std::size_t most) {
  if (differences.empty()) return "The logs do not differ in settings, robots, versions, scenario or seed.\n";
  std::string text = "What differs between the logs\n";
  for (const LogDifference& of : std::span(differences).first(std::min(most, differences.size()))) {
    std::vector<std::pair<std::string, std::vector<std::string>>> alike;  // values, logs
    for (std::size_t i = 0; i < logs.size(); ++i) {
      const std::string values = shown_values(of.values[i]);
      const auto known = std::ranges::find(alike, values, [](const auto& entry) { return entry.first; });
      (known == alike.end() ? alike.emplace_back(values, std::vector<std::string>{}) : *known)
          .second.push_back(logs[i]);
    }
    std::vector<std::string> sides;
    sides.reserve(alike.size());
    for (const auto& [values, names] : alike) sides.push_back(fmt::format("{} in {}", values, fmt::join(names, ", ")));
    const std::string line = fmt::format("{} {}: {}", of.part, of.key, fmt::join(sides, "; "));
    text += "  " + wrapped(kicking::printable(line), "    ") + "\n";
  }
  if (differences.size() > most) text += fmt::format("  and {} more keys (--all)\n", differences.size() - most);
  return text;
}

Json differences_json(const std::vector<LogDifference>& differences, std::span<const std::string> logs) {
  Json all = Json::array();
  for (const LogDifference& of : differences) {
    Json values = Json::array();
    for (std::size_t i = 0; i < logs.size(); ++i) values.push_back({{"log", logs[i]}, {"values", of.values[i]}});
    all.push_back({{"part", of.part}, {"key", of.key}, {"values", values}});
  }
  return all;
}

}  // namespace trivela::evaluator
