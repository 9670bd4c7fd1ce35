#include "cli/simulate/arms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
#include "config/arms.hpp"
#include "config/learned_model.hpp"
#include "nodes/recorder/session_text.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

config::ArmFields arm_named(const std::string& name) {
  config::ArmFields arm;
  arm.name = name;
  const auto at = name.find('@');
  const std::string policy = name.substr(0, at);
  if (at != std::string::npos) arm.table = name.substr(at + 1);
  bool known = false;
  for (std::size_t i = 0; i < kicking::kPolicyCount; ++i) {
    const auto candidate = static_cast<kicking::PolicyName>(i);
    if (policy != kicking::name(candidate)) continue;
    arm.policy = candidate;
    known = true;
  }
  if (!known) throw UsageError{fmt::format("--arms: \"{}\" is no policy", policy)};
  if (arm.table != nodes::kNewTable && arm.table != nodes::kOldTable)
    throw UsageError{fmt::format("--arms: \"{}\": a table is new or old", name)};
  return arm;
}

std::vector<config::ArmFields> arms_named(const std::string& text) {
  std::vector<config::ArmFields> arms;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    arms.push_back(arm_named(text.substr(begin, end - begin)));
    for (std::size_t i = 0; i + 1 < arms.size(); ++i) {
      if (arms[i].name == arms.back().name)
        throw UsageError{fmt::format("--arms: \"{}\" stands there twice", arms[i].name)};
    }
    begin = end + 1;
  }
  return arms;
}

std::vector<std::string> default_robots() {
  std::vector<std::string> files;
  const fs::path folder = fs::path{TRIVELA_CONFIG_DIR} / "robots";
  for (int n = 1; n <= 5; ++n) {
    const fs::path file = folder / fmt::format("calibrated_{}.toml", n);
    if (fs::exists(file)) files.push_back(file.string());
  }
  if (files.empty()) files.push_back((folder / "cambada_1.toml").string());
  return files;
}

bool is_drive(kicking::PolicyName policy) {
  return policy >= kicking::PolicyName::kStandingDrive && policy <= kicking::PolicyName::kStraightDrive;
}

void check_policy(const std::string& arm, kicking::PolicyName policy, const config::Settings& settings) {
  if (is_drive(policy)) {
    throw UsageError{fmt::format("arm {}: {} calibrates a robot (trivela calibrate run) and is no policy of play", arm,
                                 kicking::name(policy))};
  }
  if (policy == kicking::PolicyName::kLearned && !settings.policy.learned) {
    throw UsageError{
        fmt::format("arm {}: the policy learned needs a model: --set kick_decision.learned_model=FILE", arm)};
  }
}

nodes::Arm arm_of(const config::ArmFields& fields, const ArmBase& base) {
  nodes::Arm arm;
  arm.name = fields.name;
  arm.policy = fields.policy;
  arm.table = fields.table;
  arm.settings = config::load_settings(base.config);
  for (const auto& lines : {base.overrides, fields.set}) {
    for (const std::string& line : lines) config::override_setting(arm.settings, line);
  }
  arm.settings.policy.cycle_s = arm.settings.run.cycle_s;
  const std::string& model = arm.settings.kick_decision.learned_model;
  if (!model.empty()) arm.settings.policy.learned = config::load_learned_model(model).model;
  arm.robots.clear();
  const auto& robots = !fields.robots.empty() ? fields.robots : !base.robots.empty() ? base.robots : default_robots();
  for (const std::string& robot : robots) arm.robots.push_back(config::load_robot(robot));
  for (std::size_t i = 0; i < fields.random.size(); ++i) {
    check_policy(arm.name, fields.random[i], arm.settings);
    const double alike = 1.0 / static_cast<double>(fields.random.size());
    arm.random.push_back(
        {fields.random[i], i < fields.random_probabilities.size() ? fields.random_probabilities[i] : alike});
  }
  if (arm.random.empty()) check_policy(arm.name, arm.policy, arm.settings);
  config::KickDecision check = arm.settings.kick_decision;
  check.random = fields.random;
  check.random_probabilities = fields.random_probabilities;
  config::check_policies(check, "arm " + arm.name);
  return arm;
}

}  // namespace

std::vector<nodes::Arm> arms_of(const std::string& text, const ArmBase& base) {
  std::vector<nodes::Arm> arms;
  for (const config::ArmFields& fields : text.ends_with(".toml") ? config::load_arms(text) : arms_named(text))
    arms.push_back(arm_of(fields, base));
  return arms;
}

std::string describe(const nodes::Arm& arm) {
  std::string text =
      fmt::format("name = {}\npolicy = {}\ntable = {}\n", arm.name, kicking::name(arm.policy), arm.table);
  for (const nodes::PolicyChance& chance : arm.random)
    text += fmt::format("random {} {}\n", kicking::name(chance.policy), chance.probability);
  text += nodes::session_config(arm.settings, arm.robots, nullptr);
  const std::string& model = arm.settings.kick_decision.learned_model;
  if (model.empty()) return text;
  std::ifstream in{model, std::ios::binary};
  return text + "\n### learned model\n" + std::string{std::istreambuf_iterator<char>{in}, {}};
}

}  // namespace trivela::cli
