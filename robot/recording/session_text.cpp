#include "robot/recording/session_text.hpp"

#include <fmt/core.h>

#include "idl_text.hpp"
#include "robot/decision/assignment.hpp"

namespace trivela::robot {
namespace {

config::Settings set_up(config::Settings settings) {
  settings.domain.domain_id = config::Domain{}.domain_id;
  settings.domain.tag = config::Domain{}.tag;
  settings.team_link = config::TeamLink{};
  settings.recorder.log = config::Recorder{}.log;
  settings.scan_recorder.file = config::ScanRecorder{}.file;
  settings.run.team = config::Run{}.team;
  settings.run.robot = config::Run{}.robot;
  settings.run.scenario = config::Run{}.scenario;
  settings.run.field_file = config::Run{}.field_file;
  settings.run.memory_limit_mb = config::Run{}.memory_limit_mb;
  settings.run.log_level = config::Run{}.log_level;
  return settings;
}

}  // namespace

std::string session_config(const config::Settings& settings, const std::vector<config::Robot>& robots,
                           const std::string& scenario_toml) {
  std::string text = "### settings\n" + config::to_toml_text(set_up(settings));
  for (std::size_t i = 0; i < robots.size(); ++i)
    text += (i == 0 ? "\n### robot\n" : fmt::format("\n### robot {}\n", i + 1)) + config::to_toml_text(robots[i]);
  if (!scenario_toml.empty()) text += "\n### scenario\n" + scenario_toml;
  return text;
}

std::vector<log::HalfPolicy> session_policies(const config::KickDecision& settings, std::size_t halves) {
  std::vector<log::HalfPolicy> policies;
  if (!settings.random.empty()) return policies;
  for (std::size_t robot_id = 0; robot_id <= settings.policy_by_robot.size(); ++robot_id) {
    const PolicyAssignment assignment{settings, static_cast<std::uint8_t>(robot_id)};
    for (std::size_t half = 1; half <= halves; ++half) {
      const auto policy = assignment.in_charge(static_cast<std::uint8_t>(half), 0).policy;
      policies.push_back({static_cast<int>(half), kicking::name(policy), static_cast<int>(robot_id)});
    }
  }
  return policies;
}

const char* idl_text() { return kIdlText; }

}  // namespace trivela::robot
