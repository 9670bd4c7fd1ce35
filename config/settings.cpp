#include "config/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "config/field.hpp"
#include "config/learned_model.hpp"
#include "config/settings_fields.hpp"
#include "config/text/installation.hpp"
#include "config/text/ipv4.hpp"
#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::config {
namespace {

std::array<std::string*, 6> files_of(Settings& settings) {
  return {&settings.run.robot,       &settings.run.scenario,       &settings.run.field_file,
          &settings.domain.dds_file, &settings.team_link.dds_file, &settings.kick_decision.learned_model};
}

/// Robot and world that the file does not name are the shipped ones, wherever it lies.
void take_shipped(const TomlSource& said, Settings& settings) {
  if (!said.root.at_path("run.robot")) settings.run.robot = absolute(shipped(settings.run.robot)).string();
  if (!said.root.at_path("run.scenario")) settings.run.scenario = absolute(shipped(settings.run.scenario)).string();
}

/// Brings policy.learned in line with kick_decision.learned_model.
void read_learned_model(Settings& settings, const std::string& source) {
  const KickDecision& k = settings.kick_decision;
  settings.policy.learned.reset();
  if (!k.learned_model.empty()) settings.policy.learned = load_learned_model(k.learned_model).model;
  if (settings.policy.learned) return;
  for (const auto& policies : {k.policy_by_half, k.policy_by_robot, k.random}) {
    const auto who = std::ranges::find_if(policies, [](auto policy) { return facts(policy).needs_model(); });
    if (who == policies.end()) continue;
    throw Error{fmt::format(
        "{}: policy \"{}\" needs kick_decision.learned_model, a file that `trivela study learn` has written, such as "
        "--set 'kick_decision.learned_model=\"config/learned.toml\"'",
        source, name(*who))};
  }
}

/// Brings goal, field and rules in line with run.field_file. Throws Error naming the first line of `said` that says
/// otherwise.
void follow_field_file(Settings& settings, const std::vector<TomlSource>& said) {
  if (settings.run.field_file.empty()) return;
  const auto own = setting_values(settings);
  settings = on_field(load_field(settings.run.field_file), settings);
  for (const auto& [key, value] : setting_values(settings)) {
    if (value == own.at(key)) continue;
    for (const TomlSource& source : said) {
      const toml::node_view node = source.root.at_path(key);
      if (!node) continue;
      throw Error{fmt::format("{}:{}: {} = {}, but run.field_file, {}, says {}", source.file,
                              node.node()->source().begin.line, key, own.at(key), settings.run.field_file, value)};
    }
  }
}

void check_lockstep(const Settings& settings, const std::string& source) {
  const auto check = [&](const char* key, const auto& device) {
    if (!settings.run.lockstep || plays_in_lockstep(device)) return;
    throw Error{
        fmt::format("{}: run.lockstep = true, but {} = \"{}\" has a time of its own: lockstep is for simulated devices",
                    source, key, text_of(device))};
  };
  check("hal.wheels", settings.hal.wheels);
  check("hal.gyro", settings.hal.gyro);
  check("hal.kicker", settings.hal.kicker);
  if (settings.scan_recorder.enabled) check("scan_recorder.device", settings.scan_recorder.device);
}

void check_group(const Refbox& refbox, const std::string& source) {
  if (refbox.letters || refbox.group.empty()) return;
  const auto group = ipv4(refbox.group);
  if (group && *group >> 28 == 0xE) return;
  throw Error{
      fmt::format("{}: refbox.group = \"{}\": expected our multicast group, 224.16.32.N", source, refbox.group)};
}

void check_standby(const Settings& settings, const std::string& source) {
  if (!settings.kick_decision.standby) return;
  const auto refuse = [&](const char* other, const char* why) {
    throw Error{fmt::format("{}: {} = true, but kick_decision.standby = true: {}", source, other, why)};
  };
  if (settings.run.lockstep) refuse("run.lockstep", "in lockstep nobody takes over");
  if (settings.run.one_process) refuse("run.one_process", "when the first dies, the second has no world_state");
}

/// What follows from several settings together.
void settle(Settings& settings, const std::string& source) {
  check_policies(settings.kick_decision, source);
  check_lockstep(settings, source);
  check_standby(settings, source);
  check_group(settings.refbox, source);
  if (settings.recorder.log.empty())
    throw Error{fmt::format("{}: recorder.log = \"\": expected a file, a folder or a pattern", source)};
  settings.policy.cycle_s = settings.run.cycle_s;
  read_learned_model(settings, source);
}

bool in_charge(const KickDecision& settings, kicking::PolicyName policy) {
  const auto names = [&](const std::vector<kicking::PolicyName>& some) {
    return std::ranges::find(some, policy) != some.end();
  };
  return names(settings.policy_by_half) || names(settings.policy_by_robot) || names(settings.random);
}

/// Whether the values of the policy at this place behind the rows are the usual ones.
bool is_usual(std::size_t place, const std::vector<double>& values) {
  const auto settings = kicking::policies()[kicking::kPolicyCount + place]->settings();
  return std::ranges::equal(values, settings, {}, {}, &kicking::PolicySetting::usual);
}

/// What is wrong with one of the lines, which stands in the message: the number of the line in itself says nothing.
std::string sentence_on_line(const std::string& what, const std::vector<std::string>& lines,
                             const std::string& called) {
  for (const std::string& line : lines) {
    const std::string place = fmt::format("{} {}", called, line), numbered = place + ":1: ";
    if (what.starts_with(numbered))
      return fmt::format("{}: {}{}", place, what.substr(numbered.size()), quotes_advice(what, line, called));
  }
  return what;
}

}  // namespace

Settings load_settings(const std::filesystem::path& path) {
  Settings settings;
  std::vector<TomlSource> said;  // moved, not copied: a copy forgets its lines
  said.push_back(parse_file(path));
  read_into(said.front(), settings);
  take_shipped(said.front(), settings);
  for (std::string* const file : files_of(settings)) {
    if (!file->empty()) *file = (path.parent_path() / *file).string();  // what is whole stays
  }
  follow_field_file(settings, said);
  settle(settings, said.front().file);
  return settings;
}

void make_files_whole(Settings& settings) {
  for (std::string* const file : files_of(settings)) {
    if (!file->empty()) *file = std::filesystem::absolute(*file).lexically_normal().string();
  }
}

void check_policies(const KickDecision& settings, const std::string& source) {
  if (settings.policy_by_half.empty()) {
    throw Error{fmt::format("{}: kick_decision.policy_by_half is empty: name at least one policy", source)};
  }
  const auto& random = settings.random;
  for (std::size_t i = 0; i < random.size(); ++i) {
    if (std::find(random.begin(), random.begin() + static_cast<std::ptrdiff_t>(i), random[i]) !=
        random.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw Error{fmt::format("{}: kick_decision.random names \"{}\" twice", source, kicking::name(random[i]))};
    }
  }
  const auto& probabilities = settings.random_probabilities;
  if (probabilities.empty()) return;
  if (probabilities.size() != settings.random.size()) {
    throw Error{fmt::format("{}: kick_decision.random_probabilities has {} entries, kick_decision.random {}", source,
                            probabilities.size(), settings.random.size())};
  }
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  if (std::abs(sum - 1.0) > 1e-9) {
    throw Error{fmt::format("{}: kick_decision.random_probabilities = [{}] sum up to {}, not 1", source,
                            fmt::join(probabilities, ", "), sum)};
  }
}

void override_settings(Settings& settings, const std::vector<std::string>& lines, const std::string& called) {
  try {
    std::vector<TomlSource> said;
    for (const std::string& line : lines)
      read_into(said.emplace_back(parse_text(line, fmt::format("{} {}", called, line))), settings);
    follow_field_file(settings, said);
  } catch (const Error& error) {
    throw Error{sentence_on_line(error.what(), lines, called)};
  }
  settle(settings, "the settings");
}

std::string to_toml_text(const Settings& settings) {
  Settings said = settings;
  kicking::complete_own_settings(said.policy.own);
  std::string without_settings;
  for (std::size_t i = 0; i < said.policy.own.size(); ++i) {
    const auto name = static_cast<kicking::PolicyName>(kicking::kPolicyCount + i);
    if (!in_charge(settings.kick_decision, name) && is_usual(i, said.policy.own[i])) said.policy.own[i].clear();
    if (in_charge(settings.kick_decision, name) && said.policy.own[i].empty())
      without_settings += fmt::format("\n[policy.own.{}]\n", kicking::name(name));
  }
  return to_toml(said) + without_settings;
}

std::vector<std::string> decision_path(const Settings& settings) {
  if (settings.run.one_process) return {"chain"};
  return {"odometry", "world_state", "kick_decision"};
}

std::map<std::string, std::string> setting_values(const Settings& settings) {
  Settings all = settings;
  kicking::complete_own_settings(all.policy.own);
  return values_in(to_toml(all));
}

}  // namespace trivela::config
