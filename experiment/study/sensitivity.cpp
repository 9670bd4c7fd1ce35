#include "experiment/study/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "config/settings_fields.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "kicking/geometry/angle.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::experiment {
namespace {

const std::string kSection = "policy.";

/// Finds one number or law by its key, reads it and may set it.
struct Finder {
  std::string_view key;
  std::optional<double> set;
  std::string section{};
  std::optional<double> found{};
  std::string label{};  // of a law

  bool is(std::string_view name) const {
    return key.size() == section.size() + name.size() && key.starts_with(section) && key.ends_with(name);
  }

  template <class T, class... Limits>
  void operator()(std::string_view name, T&& field, const Limits&... limits) {
    using Field = std::remove_cvref_t<T>;
    if constexpr (std::same_as<Field, double>) {
      if (is(name)) number(field, field, 1.0, limits...);
    } else if constexpr (std::same_as<Field, kicking::Degrees>) {
      if (is(name)) number(field.rad, kicking::degrees(field.rad), kicking::radians(1.0), limits...);
    } else if constexpr (config::NamedEnum<Field>) {
      if (is(name)) law(field);
    } else if constexpr (config::Section<Field>) {
      const std::string outer = section;
      section += std::string{name} + '.';
      fields(*this, field);
      section = outer;
    }
  }

  /// `shown` is the field in the unit of its key, which is `unit` of the field's.
  void number(double& field, double shown, double unit, const auto&... limits) {
    found = shown;
    if (!set) return;
    ((limits.contains(*set) ? void() : refuse()), ...);
    field = *set * unit;
  }

  template <class E>
  void law(E& field) {
    const auto entries = config::names_of<E>();
    if (set && (*set < 0.0 || *set > static_cast<double>(entries.size() - 1) || *set != std::floor(*set))) refuse();
    if (set) field = entries[static_cast<std::size_t>(*set)].second;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (entries[i].second != field) continue;
      found = static_cast<double>(i);
      label = entries[i].first;
    }
  }

  void refuse() const { throw std::invalid_argument{fmt::format("{} = {}: beyond its limits", key, *set)}; }
};

Finder visit(auto& where, const std::string& section, const std::string& key, std::optional<double> value) {
  Finder finder{key, value, section};
  fields(finder, where);
  if (finder.found) return finder;
  throw std::invalid_argument{
      fmt::format("\"{}\" is no number of a {}", key, section.empty() ? "scenario" : "policy's settings")};
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
      const config::Row row{header->cells, record->cells};
      UncertainInput input{row.word("key").value_or(""), row.number("low"), row.number("high"),
                           row.word("why").value_or("")};
      if (!(input.low < input.high)) throw std::invalid_argument{"low is not below high"};
      for (const double end : {input.low, input.high})
        is_setting(input.key) ? void(with(kicking::PolicyConfig{}, input.key, end))
                              : void(value_of(sim::Scenario{}, input.key));
      inputs.push_back(std::move(input));
    } catch (const std::exception& error) {
      throw config::Error{fmt::format("{}:{}: {}", path, record->line, error.what())};
    }
  }
  if (inputs.empty()) throw config::Error{fmt::format("{}: names no input (key,low,high,why)", path)};
  return inputs;
}

bool is_setting(std::string_view key) { return key.starts_with(kSection); }

bool in_force(const sim::Scenario& scenario, const UncertainInput& input) {
  const std::string& key = input.key;
  if (key.starts_with("keeper.") || key.starts_with("policy.keeper.")) return scenario.keeper.enabled;
  return !key.starts_with("defenders.") || scenario.defenders.count > 0.0;
}

double value_of(const sim::Scenario& scenario, const std::string& key) {
  sim::Scenario copy = scenario;
  return *visit(copy, "", key, std::nullopt).found;
}

double value_of(const kicking::PolicyConfig& policy, const std::string& key) {
  kicking::PolicyConfig copy = policy;
  return *visit(copy, kSection, key, std::nullopt).found;
}

sim::Scenario with(const sim::Scenario& scenario, const std::string& key, double value) {
  sim::Scenario changed = scenario;
  visit(changed, "", key, value);
  if (const auto problem = sim::first_problem(changed)) {
    throw std::invalid_argument{fmt::format("{} = {}: {}: {}", key, value, problem->key, problem->why)};
  }
  return changed;
}

kicking::PolicyConfig with(const kicking::PolicyConfig& policy, const std::string& key, double value) {
  kicking::PolicyConfig changed = policy;
  visit(changed, kSection, key, value);
  return changed;
}

std::string value_text(const std::string& key, double value) {
  if (!is_setting(key)) return fmt::format("{:g}", value);
  kicking::PolicyConfig any;
  const std::string law = visit(any, kSection, key, value).label;
  return law.empty() ? fmt::format("{:g}", value) : law;
}

Effect headline(const std::vector<ArmTally>& arms, std::size_t i, Measure measure) {
  const Term terms[] = {{&arms.at(i + 1), 1.0}, {&arms.at(i), -1.0}};
  return contrast(terms, measure);
}

Effect change(const SensitivityReport& report, const PlayedEnd& end, std::size_t i) {
  const Term terms[] = {
      {&end.arms.at(i + 1), 1.0}, {&end.arms.at(i), -1.0}, {&report.base.at(i + 1), -1.0}, {&report.base.at(i), 1.0}};
  return contrast(terms, report.measure);
}

double largest_change(const SensitivityReport& report, const PlayedInput& input) {
  double largest = 0.0;
  for (const PlayedEnd& end : input.ends) {
    for (std::size_t i = 0; i + 1 < report.arms.size(); ++i)
      largest = std::max(largest, std::abs(change(report, end, i).value));
  }
  return largest;
}

void sort_by_change(SensitivityReport& report) {
  std::ranges::stable_sort(report.inputs, std::ranges::greater{},
                           [&](const PlayedInput& input) { return largest_change(report, input); });
}

}  // namespace trivela::experiment
