#include "experiment/run/arms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "config/learned_model.hpp"
#include "config/text/error.hpp"

namespace trivela::experiment {
namespace {

/// A setting, or a table of them, that an experiment in process does not look at.
struct IdleKey {
  std::string_view key;
  std::string_view instead;
};

constexpr IdleKey kIdleKeys[] = {
    {"run.robot_id", "the scenario's [team] says which robots play (--scenario)"},
    {"run.robot", "--robot names the robots' files"},
    {"run.scenario", "--scenario names the world"},
    {"run.field_file", "the scenario names the field (--scenario)"},
    {"run.session", "--seed says which matches are played"},
    {"run.lockstep", "every match in process is played in lockstep"},
    {"run.memory_limit_mb", "no node runs whose memory is watched"},
    {"run.log_level", "no node runs that could log"},
    {"domain", "there is no bus; trivela match has one"},
    {"goal", "goal and rules are the scenario's [field] and [rules] (--scenario)"},
    {"rules", "goal and rules are the scenario's [field] and [rules] (--scenario)"},
    {"field", "the field is the scenario's (--scenario)"},
    {"hal", "devices are the simulator's; trivela match has others"},
    {"policy.test_drive", "drives calibrate a robot (trivela calibrate run)"},
    {"kick_decision.assignment_seed", "each match draws by its own seed, which follows from --seed"},
    {"kick_decision.shadows", "trivela simulate --shadows records what other policies would have done"},
    {"self_calibration.state_file", "each match begins with the robots' files"},
    {"self_calibration.state_max_age_h", "each match begins with the robots' files"},
    {"simulator.seed", "--seed says which matches are played"},
    {"simulator.max_possessions", "--possessions says how long a match is"},
    {"simulator", "a match is one half, and --possessions says how long"},
    {"recorder.log", "--out names the log"},
    {"recorder", "no recorder runs; a match is written when it is played"},
    {"scan_recorder", "no scanner runs; trivela match has one"},
};

constexpr std::string_view kByHalf = "kick_decision.policy_by_half";
constexpr std::string_view kByRobot = "kick_decision.policy_by_robot";
constexpr std::string_view kRandom = "kick_decision.random";
constexpr std::string_view kProbabilities = "kick_decision.random_probabilities";

void refuse_idle(const std::string& key, const std::string& place) {
  for (const IdleKey& idle : kIdleKeys) {
    if (key != idle.key && !key.starts_with(std::string{idle.key} + ".")) continue;
    throw config::BadArgument{fmt::format("{}: {} plays no part in process: {}", place, key, idle.instead)};
  }
}

/// Does a setting that was given say who plays, and something else than the arm does?
bool contradicts(std::string_view key, const config::KickDecision& settings, const config::ArmFields& arm) {
  if (key == kByHalf) return !arm.policy || settings.policy_by_half != std::vector{*arm.policy};
  if (key == kByRobot) return !settings.policy_by_robot.empty();
  if (key == kRandom) return !settings.random.empty();
  return key == kProbabilities && !settings.random_probabilities.empty();
}

void check_assignment(const std::vector<std::string>& given, const config::KickDecision& settings,
                      const config::ArmFields& arm) {
  const bool arm_says = arm.policy || !arm.random.empty();
  for (const std::string& key : given) {
    if (arm_says && contradicts(key, settings, arm)) {
      throw config::BadArgument{fmt::format("{}: {} says who plays, and so does the arm's {}; leave one out", arm.place,
                                            key, arm.policy ? "policy" : "random")};
    }
    if (!arm_says && key == kByHalf && settings.policy_by_half.size() > 1) {
      throw config::BadArgument{fmt::format("{}: {} names {} halves, and a match in process is one; name one policy",
                                            arm.place, key, settings.policy_by_half.size())};
    }
  }
  if (!arm_says) config::check_policies(settings, arm.place);
}

}  // namespace

config::Settings arm_settings(const config::ArmFields& arm, const std::string& config,
                              std::vector<config::SettingLine> overrides) {
  config::Settings settings = config::load_settings(config);
  overrides.insert(overrides.end(), arm.set.begin(), arm.set.end());
  std::vector<std::string> given;
  for (const config::SettingLine& line : overrides) {
    for (std::string& key : config::override_setting(settings, line)) {
      refuse_idle(key, line.place);
      if (key == kByHalf || key == kByRobot || key == kRandom || key == kProbabilities) given.push_back(std::move(key));
    }
  }
  check_assignment(given, settings.kick_decision, arm);
  settings.policy.cycle_s = settings.run.cycle_s;
  const std::string& model = settings.kick_decision.learned_model;
  try {
    if (!model.empty()) settings.policy.learned = config::load_learned_model(model).model;
  } catch (const config::Error& error) {
    throw config::Error{fmt::format("{}: kick_decision.learned_model: {}", arm.place, error.what())};
  }
  return settings;
}

}  // namespace trivela::experiment
