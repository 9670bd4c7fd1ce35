#include "cli/options/play_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cli/options/number_checks.hpp"
#include "config/scenario/scenario.hpp"

namespace trivela::cli {
namespace {

/// The key by which the scenario has nothing of what `key` is a value of: a keeper, a lever, a laser. Empty: it has it.
std::string switched_off(const std::string& key, const sim::Scenario& scenario) {
  const auto values = config::scenario_values(scenario);
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1)) {
    std::string enabled = key.substr(0, dot) + ".enabled";
    const auto value = values.find(enabled);
    if (key != enabled && value != values.end() && value->second == "false") return enabled;
  }
  return {};
}

}  // namespace

sim::Scenario World::load() const {
  sim::Scenario scenario = config::load_scenario(file);
  for (const std::string& line : changes) config::override_scenario(scenario, line, "--world");
  return scenario;
}

void World::require_effect(const std::vector<sim::Scenario>& played) const {
  for (const std::string& line : changes) {
    const std::string key = line.substr(0, line.find_first_of(" \t="));
    const auto has_it = [&](const sim::Scenario& scenario) { return switched_off(key, scenario).empty(); };
    if (std::ranges::none_of(played, has_it))
      throw UsageError{fmt::format("--world {}: {} has no effect, since {} = false in {}", line, key,
                                   switched_off(key, played.front()), played.size() > 1 ? "all worlds" : "this world")};
  }
}

std::string World::named(const std::string& base) const {
  std::string name = base;
  for (const std::string& line : changes) name += ", " + line;
  return name;
}

void add_world_options(CLI::App& verb, World& world, std::uint32_t* calibrations) {
  add_default(verb, "--scenario", world.file, "The world", readable_file());
  verb.add_option("--world", world.changes, "One value of it on top, e.g. --world kicker.delay_s=0.03");
  if (calibrations == nullptr) return;
  add_default(verb, "--calibrations", *calibrations,
              "Simulated calibrations that the robots come from, match m with calibration m mod K; 0: robot files",
              CLI::Range(0u, 1000u))
      ->type_name("K");
}

namespace {

using log::Shard;

/// None: it is no shard.
std::optional<Shard> shard_of(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc{} || number.ptr == end || *number.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(number.ptr + 1, end, shard.count);
  const bool holds = count.ec == std::errc{} && count.ptr == end && shard.number >= 1 && shard.number <= shard.count;
  return holds ? std::optional{shard} : std::nullopt;
}

}  // namespace

void add_shard_option(CLI::App& verb, std::optional<Shard>& shard, const std::string& footnote) {
  verb.add_option_function<std::string>(
          "--shard", [&shard](const std::string& text) { shard = shard_of(text); },
          "Play the K-th of N parts of the matches alone; " + footnote)
      ->check(CLI::Validator(
          [](std::string& text) {
            return shard_of(text) ? std::string{} : fmt::format("{} is not K/N with K from 1 to N", text);
          },
          ""))
      ->type_name("K/N");
}

void check_shard(const std::optional<Shard>& shard, std::uint32_t matches) {
  if (shard && shard->count > matches)
    throw UsageError{fmt::format("--shard {}: more parts than --matches {}", shard->text(), matches)};
}

}  // namespace trivela::cli
