#include <fmt/core.h>
#include <fmt/ranges.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "cli/launch/record_match.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/verbs.hpp"
#include "cli/watch/watch_page.hpp"
#include "config/arms.hpp"
#include "config/field.hpp"
#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "nodes/runtime/node_flags.hpp"
#include "nodes/simulator/simulator_node.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"

namespace trivela::cli {
namespace {

/// Keys of a robot in a private temporary folder, which goes with the object.
class ThrowawayKeys {
 public:
  /// For every kind of node. Throws std::system_error where no folder can be made.
  explicit ThrowawayKeys(std::uint32_t robot_id) {
    std::string pattern = (std::filesystem::temp_directory_path() / "trivela_keys_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::system_error{errno, std::generic_category(), pattern};
    folder_ = pattern;
    const security::KeyFolder keys{folder_};
    const security::Validity today = security::days_from(security::this_second(), 1);
    keys.init(today);
    std::vector<std::string> every;
    for (const security::Rights& rights : security::all_rights()) every.push_back(rights.node);
    keys.issue(robot_id, every, today);
  }
  ThrowawayKeys(const ThrowawayKeys&) = delete;
  ThrowawayKeys& operator=(const ThrowawayKeys&) = delete;
  ~ThrowawayKeys() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// From now on the nodes that this process starts join the bus with the keys in the folder. An empty name: with keys
/// made for the purpose, which the result keeps. Throws UsageError naming what is wrong with the folder's keys.
std::unique_ptr<ThrowawayKeys> secure_children(const std::string& folder, std::uint32_t robot_id) {
  if (folder.empty()) {
    auto keys = std::make_unique<ThrowawayKeys>(robot_id);
    setenv(nodes::kKeysVariable, keys->folder().c_str(), 1);
    return keys;
  }
  const auto faults = security::faults_of(security::KeyFolder{folder}, security::this_second());
  if (!faults.empty()) throw UsageError{fmt::format("--secure: {}", faults.front())};
  setenv(nodes::kKeysVariable, std::filesystem::absolute(folder).c_str(), 1);
  return nullptr;
}

/// Policies of play before the drives; one that needs the truth is refused by a sentence of its own.
std::vector<std::string> half_policies() {
  std::vector<std::string> names = kicking::policies_where([](const auto& policy) { return policy.plays(); });
  for (std::string& drive : kicking::policies_where([](const auto& policy) { return !policy.plays(); }))
    names.push_back(std::move(drive));
  return names;
}

constexpr const char* kEmulated = "emulated";

struct MatchFlags {
  std::vector<std::string> halves;
  std::string random;
  bool paired_halves = false;
  std::optional<double> minutes;
  std::int64_t seed = 1;
  std::string devices = "sim";
  int domain = -1;
  std::string out = "match.db";
  std::string config = config::shipped("default.toml").string();
  std::vector<std::string> overrides;
  std::string log_level = "warn";
  std::string keys;
  bool watch = false;
  double pace = 1.0;
  WatchFlags page;
};

std::string list(const std::vector<std::string>& policies) {
  std::string text;
  for (const std::string& policy : policies) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", policy);
  return "[" + text + "]";
}

void refuse_oracle(const config::KickDecision& decision) {
  for (const auto& policies : {decision.policy_by_half, decision.policy_by_robot, decision.random}) {
    const auto who = std::ranges::find_if(policies, [](auto policy) { return facts(policy).needs_truth(); });
    if (who == policies.end()) continue;
    throw UsageError{fmt::format(
        "the policy {} needs the simulator's true state, which is not on the bus: play it with trivela simulate",
        kicking::name(*who))};
  }
}

/// A flag and --set that say two things of one setting would leave it to chance which one somebody meant.
void refuse_settings_of_flags(const std::vector<std::string>& overrides) {
  static const std::pair<std::string, const char*> kFlags[] = {
      {"kick_decision.policy_by_half", "--half"},
      {"kick_decision.random", "--random"},
      {"simulator.halves", "--half"},
      {"simulator.half_minutes", "--minutes"},
      {"simulator.paired_halves", "--paired-halves"},
      {"simulator.seed", "--seed"},
      {"simulator.devices", "--devices"},
      {"simulator.pace", "--pace"},
      {"run.log_level", "--log-level"},
  };
  for (const std::string& line : overrides) {
    const std::string key = line.substr(0, line.find_first_of(" ="));
    for (const auto& [setting, flag] : kFlags) {
      if (key == setting) throw UsageError{fmt::format("--set {}: {} says it", line, flag)};
    }
  }
}

std::vector<std::string> drawn_policies(const std::string& random) {
  std::vector<std::string> policies = CLI::detail::split(random, ',');
  const std::vector<std::string> known = half_policies();
  for (const std::string& policy : policies) {
    if (std::ranges::find(known, policy) != known.end()) continue;
    const auto drawn = kicking::policies_where([](const auto& any) { return any.plays() && !any.needs_truth(); });
    throw UsageError{fmt::format("--random: '{}' is no policy; there are {}", policy, fmt::join(drawn, ", "))};
  }
  return policies;
}

/// Lines such as `kick_decision.policy_by_half = ["stopped", "moving"]`: the checks of the configuration are the flags'
/// too.
config::Settings settings_of(const MatchFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  if (flags.devices == kEmulated) settings = with_emulated_devices(std::move(settings));
  std::vector<std::string> lines;
  if (!flags.halves.empty()) lines.push_back(fmt::format("kick_decision.policy_by_half = {}", list(flags.halves)));
  if (!flags.random.empty())
    lines.push_back(fmt::format("kick_decision.random = {}", list(drawn_policies(flags.random))));
  if (flags.paired_halves) lines.emplace_back("simulator.paired_halves = true");
  if (flags.watch) lines.push_back(fmt::format("simulator.pace = {:.17e}", flags.pace));
  for (std::string line :
       {fmt::format("simulator.halves = {}", std::max<std::size_t>(flags.halves.size(), 1)),
        fmt::format("kick_decision.assignment_seed = {}", flags.seed), fmt::format("simulator.seed = {}", flags.seed),
        fmt::format("run.log_level = \"{}\"", flags.log_level)})
    lines.push_back(std::move(line));
  refuse_settings_of_flags(flags.overrides);
  for (const std::string& line : flags.overrides) {
    config::require_own_policy(line, "--set " + line);
    lines.push_back(line);
  }
  config::override_settings(settings, lines, "--set");
  refuse_oracle(settings.kick_decision);
  const sim::Scenario scenario = config::load_scenario(settings.run.scenario);
  if (const auto contradiction = config::field_contradiction(scenario, settings))
    throw config::Error{fmt::format("{}: {}", settings.run.scenario, *contradiction)};
  settings = config::on_field_of(scenario, std::move(settings));
  settings.simulator.half_minutes = flags.minutes.value_or(scenario.referee.half_minutes);
  nodes::scenario_of(settings);
  config::robot_for(config::load_robot(settings.run.robot), settings);
  return settings;
}

int play(const MatchFlags& flags, bool secured, bool paced) {
  if (flags.halves.empty() && flags.random.empty()) throw UsageError{"--half or --random is required"};
  if (flags.devices == kEmulated && paced)
    throw UsageError{"--pace: against emulated devices a match is played in real time"};
  config::Settings settings = settings_of(flags);
  if (flags.devices != kEmulated) refuse_real_devices(settings.hal);
  const auto keys = secured ? secure_children(flags.keys, settings.run.robot_id) : nullptr;
  const WatchFlags* const page = flags.watch ? &flags.page : nullptr;
  return flags.devices == kEmulated ? record_emulated(std::move(settings), flags.domain, flags.out, page)
                                    : record_lockstep("simulator", std::move(settings), flags.domain, flags.out, page);
}

/// What is played: by whom, how long, with which world.
void add_play_flags(CLI::App& verb, MatchFlags& flags) {
  auto* half = verb.add_option("--half", flags.halves, "policy in charge of a half, one --half each")
                   ->expected(1)
                   ->check(CLI::IsMember(half_policies()))
                   ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_option("--random", flags.random,
                  "policies such as stopped,moving,predictive: one half, one of them drawn for each possession")
      ->excludes(half);
  verb.add_flag("--paired-halves", flags.paired_halves,
                "the same possessions in every half; otherwise each has its own")
      ->needs(half);
  verb.add_option("--minutes", flags.minutes, "length of a half; default: the scenario's, referee.half_minutes")
      ->check(between(0.01, 1000.0));
  add_default(verb, "--seed", flags.seed, "same seed, same match", seeds());
  add_default(verb, "--devices", flags.devices,
              "sim: on the bus, as fast as the nodes answer; emulated: the kicker's board (hal.kicker, else an "
              "ioBoard) at a line and a referee box on TCP, in real time",
              CLI::IsMember({"sim", kEmulated}));
}

}  // namespace

void add_match(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("match", "Play a simulated match with real node processes and record it");
  auto flags = std::make_shared<MatchFlags>();
  add_play_flags(*verb, *flags);
  verb->add_option("--domain", flags->domain, "DDS domain; default: drawn, with a discovery tag of its own")
      ->check(CLI::Range(0, 100));
  add_default(*verb, "--out", flags->out, "match log, must not exist");
  add_default(*verb, "--config", flags->config, "configuration of the nodes");
  verb->add_option("--set", flags->overrides, "one setting on top, e.g. --set policy.settle_s=0.5");
  add_default(*verb, "--log-level", flags->log_level, "of the nodes",
              CLI::IsMember(std::vector<std::string>(config::kLogLevels.begin(), config::kLogLevels.end())));
  auto* secure =
      verb->add_option("--secure", flags->keys,
                       "every node with the keys of this folder (trivela keys; ./keys where it is named like a verb), "
                       "in which simulator has some; without a folder, with keys that go with the match")
          ->expected(0, 1);
  auto* watch = verb->add_flag("--watch", flags->watch,
                               "serve a live page of the match, which stays until Ctrl-C, and print its address");
  auto* pace = verb->add_option("--pace", flags->pace,
                                "with --watch: seconds of play a second, at most; 0: as fast as the nodes answer. The "
                                "rows are the same at every pace")
                   ->check(between(0.0, 1000.0))
                   ->needs(watch)
                   ->capture_default_str();
  for (CLI::Option* option : add_watch_flags(*verb, flags->page)) option->needs(watch);
  verb->callback(
      [flags, secure, pace, &exit_code] { exit_code = play(*flags, secure->count() > 0, pace->count() > 0); });
}

}  // namespace trivela::cli
