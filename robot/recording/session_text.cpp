#include "robot/recording/session_text.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "idl_text.hpp"

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
  settings.hal.replay_log = std::filesystem::path{settings.hal.replay_log}.filename().string();
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

const char* idl_text() { return kIdlText; }

}  // namespace trivela::robot
