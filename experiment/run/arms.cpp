#include "experiment/run/arms.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "config/text/open_file.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/text/nearest_word.hpp"
#include "log/schema/digest.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::experiment {
namespace {

namespace fs = std::filesystem;
using config::BadArgument;

config::ArmFields arm_named(const std::string& name, const std::string& called) {
  config::ArmFields arm;
  arm.name = name;
  arm.place = "arm " + name;
  const auto at = name.find('@');
  const std::string policy = name.substr(0, at);
  if (at != std::string::npos) arm.table = name.substr(at + 1);
  arm.policy = kicking::policy_named(policy);
  if (!arm.policy) {
    const auto meant =
        kicking::nearest_word(policy, kicking::policies_where([](const auto& facts) { return facts.plays(); }));
    throw BadArgument{fmt::format("{}: \"{}\" is no policy{}", called, policy,
                                  meant ? fmt::format("; did you mean {}?", *meant) : "")};
  }
  if (arm.table != kNewTable && arm.table != kOldTable)
    throw BadArgument{fmt::format("{}: \"{}\": a table is new or old", called, name)};
  return arm;
}

std::vector<config::ArmFields> arms_named(const std::string& text, const std::string& called) {
  std::vector<config::ArmFields> arms;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    arms.push_back(arm_named(text.substr(begin, end - begin), called));
    for (std::size_t i = 0; i + 1 < arms.size(); ++i) {
      if (arms[i].name == arms.back().name)
        throw BadArgument{fmt::format("{}: \"{}\" stands there twice", called, arms[i].name)};
    }
    begin = end + 1;
  }
  return arms;
}

std::vector<std::string> default_robots() {
  std::vector<std::string> files;
  const fs::path folder = config::shipped("robots");
  for (int n = 1; n <= 5; ++n) {
    const fs::path file = folder / fmt::format("calibrated_{}.toml", n);
    if (fs::exists(file)) files.push_back(file.string());
  }
  if (files.empty()) files.push_back((folder / "cambada_1.toml").string());
  return files;
}

void check_policy(const config::ArmFields& arm, kicking::PolicyName policy, const config::Settings& settings,
                  const ArmBase& base) {
  if (!facts(policy).plays()) {
    throw BadArgument{fmt::format("{}: {} calibrates a robot (trivela calibrate run) and is no policy of play",
                                  arm.place, kicking::name(policy))};
  }
  if (facts(policy).needs_program()) {
    throw BadArgument{
        fmt::format("{}: the policy {} is another program's: play it with that one", arm.place, kicking::name(policy))};
  }
  if (facts(policy).needs_model() && !settings.policy.learned) {
    throw BadArgument{fmt::format("{}: the policy {} needs a model: {} 'kick_decision.learned_model=\"FILE\"'",
                                  arm.place, kicking::name(policy), base.dashes + "set")};
  }
}

std::vector<config::Robot> load_robots(const config::ArmFields& fields, const ArmBase& base) {
  std::vector<config::Robot> robots;
  try {
    for (const std::string& robot : fields.robots) robots.push_back(config::load_robot(robot));
  } catch (const config::Error& error) {
    throw config::Error{fmt::format("{}: robots: {}", fields.place, error.what())};
  }
  if (!robots.empty()) return robots;
  for (const std::string& robot : base.robots.empty() ? default_robots() : base.robots)
    robots.push_back(config::load_robot(robot));
  return robots;
}

Arm arm_of(const config::ArmFields& fields, const ArmBase& base) {
  Arm arm;
  arm.name = fields.name;
  arm.policy = fields.policy;
  arm.table = fields.table;
  std::vector<config::SettingLine> overrides;
  for (const std::string& line : base.overrides) overrides.push_back({line, base.dashes + "set " + line});
  arm.settings = arm_settings(fields, fields.config.empty() ? base.config : fields.config, std::move(overrides));
  arm.robots = load_robots(fields, base);
  arm.own_robots = !fields.robots.empty();
  for (std::size_t i = 0; i < fields.random.size(); ++i) {
    const double alike = 1.0 / static_cast<double>(fields.random.size());
    arm.random.push_back(
        {fields.random[i], i < fields.random_probabilities.size() ? fields.random_probabilities[i] : alike});
  }
  for (const kicking::PolicyName policy : policies_in(arm)) check_policy(fields, policy, arm.settings, base);
  return arm;
}

std::string file_bytes(const char* path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

/// What tells the policy's rule from a changed one: of its own, else the program and the libraries that it loaded, but
/// for the system's.
std::string code_of(const kicking::Policy& policy) {
  if (std::string code = policy.code(); !code.empty()) return code;
  static const std::string program = [] {
    std::string files = file_bytes("/proc/self/exe");
    dl_iterate_phdr(
        [](dl_phdr_info* loaded, std::size_t, void* all) {
          const std::string_view library = loaded->dlpi_name;
          const bool system = library.starts_with("/usr/lib/") || library.starts_with("/lib");
          if (library.starts_with('/') && !system) *static_cast<std::string*>(all) += file_bytes(loaded->dlpi_name);
          return 0;
        },
        &files);
    return log::sha256(files);
  }();
  return program;
}

}  // namespace

std::vector<kicking::PolicyName> policies_in(const Arm& arm) {
  const config::KickDecision decision = settings_of(arm, {}).kick_decision;
  if (!decision.random.empty()) return decision.random;
  std::vector<kicking::PolicyName> policies = decision.policy_by_robot;
  policies.push_back(decision.policy_by_half.front());
  return policies;
}

std::vector<Arm> arms_of(const std::vector<config::ArmFields>& fields, const ArmBase& base) {
  std::vector<Arm> arms;
  arms.reserve(fields.size());
  for (const config::ArmFields& arm : fields) arms.push_back(arm_of(arm, base));
  return arms;
}

std::vector<Arm> arms_of(const std::string& text, const ArmBase& base) {
  return arms_of(text.ends_with(".toml") ? config::load_arms(text) : arms_named(text, base.dashes + "arms"), base);
}

std::vector<std::string> shared_robots(const sim::Scenario& scenario, const std::vector<Arm>& arms) {
  std::vector<std::string> remarks;
  for (const Arm& arm : arms) {
    const std::size_t files = arm.robots.size();
    if (files >= team_size(scenario)) continue;
    std::string remark = fmt::format("{} robots play with {} robot file{}: {} is taken for all further ones",
                                     team_size(scenario), files, files == 1 ? "" : "s", arm.robots.back().name);
    if (std::ranges::find(remarks, remark) == remarks.end()) remarks.push_back(std::move(remark));
  }
  return remarks;
}

std::string describe(const Arm& arm) {
  std::string text = fmt::format("name = {}\n", arm.name);
  if (arm.policy) text += fmt::format("policy = {}\n", kicking::name(*arm.policy));
  text += fmt::format("table = {}\n", arm.table);
  for (const robot::PolicyChance& chance : arm.random)
    text += fmt::format("random {} {}\n", kicking::name(chance.policy), chance.probability);
  for (const kicking::PolicyName policy : policies_in(arm)) {
    if (!from_outside(policy)) continue;
    const kicking::Policy& outside = *kicking::policies()[static_cast<std::size_t>(policy)];
    text += fmt::format("code of {} = {}\n", kicking::name(policy), code_of(outside));
  }
  text += robot::session_config(arm.settings, arm.robots);
  const std::string& model = arm.settings.kick_decision.learned_model;
  if (model.empty()) return text;
  return text + "\n### learned model\n" + config::read_text_file(model);
}

std::string describe(const std::vector<Team>& calibrations) {
  std::string text;
  for (std::size_t k = 0; k < calibrations.size(); ++k) {
    text += fmt::format("\n### calibration {}\n", k);
    for (const config::Robot& robot : calibrations[k]) text += config::to_toml_text(robot);
  }
  return text;
}

namespace {

/// What the calibration left behind, without the day on which it was computed: the same plan makes the same log
/// tomorrow.
config::Robot robot_of(const sim::Scenario& world, std::uint64_t seed, std::uint32_t calibration,
                       std::uint32_t robot_id) try {
  config::Robot robot =
      calibrated_robot(world, static_cast<std::int64_t>(calibration_seed(seed, calibration, robot_id)), robot_id);
  robot.name = fmt::format("calibration_{}_robot_{}", calibration, robot_id);
  robot.calibration.reset();
  return robot;
} catch (const std::exception& error) {
  throw std::runtime_error{fmt::format("calibration {}, robot {}: {}", calibration, robot_id, error.what())};
}

}  // namespace

void check_calibrations(const ArmBase& base, std::uint32_t calibrations, std::uint32_t matches) {
  const std::string called = base.dashes + "calibrations";
  if (calibrations > 0 && !base.robots.empty()) {
    throw config::BadArgument{
        fmt::format("{} and {} {}: robots are those of files or of calibrations; leave one out ({} 0)",
                    base.dashes.empty() ? "robots" : "--robot", called, calibrations, called)};
  }
  if (calibrations > matches) {
    throw config::BadArgument{
        fmt::format("{} {}: more calibrations than {}matches {}", called, calibrations, base.dashes, matches)};
  }
}

std::vector<Team> calibrated_teams(const sim::Scenario& world, std::uint32_t calibrations, const PlayPlan& plan,
                                   const std::function<void(std::size_t done, std::size_t all)>& progress) {
  const std::uint32_t robots = team_size(world);
  std::vector<Team> teams(calibrations, Team(robots));
  const auto play = [&](std::size_t i) {
    const auto calibration = static_cast<std::uint32_t>(i / robots), robot = static_cast<std::uint32_t>(i % robots);
    teams[calibration][robot] = robot_of(world, plan.seed, calibration, robot + 1);
  };
  in_threads(std::size_t{calibrations} * robots, plan.jobs, play, progress);
  return teams;
}

}  // namespace trivela::experiment
