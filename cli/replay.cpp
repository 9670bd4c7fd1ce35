#include <fmt/core.h>

#include <memory>

#include "cli/launch/config_file.hpp"
#include "cli/launch/record_match.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "evaluator/log/reader.hpp"
#include "hal/replay/replay_log.hpp"

namespace trivela::cli {
namespace {

struct ReplayFlags {
  std::string log;
  std::string out = "replay.db";
  std::vector<std::string> overrides;
  int domain = -1;
};

/// The part of a session's configuration under its "### name" heading.
std::string section(const std::string& config, const std::string& name, const std::string& log) {
  const std::string heading = "### " + name + "\n";
  const auto start = config.find(heading);
  if (start == std::string::npos) throw std::runtime_error{fmt::format("{}: the session holds no {}", log, name)};
  const auto end = config.find("\n### ", start);
  return config.substr(start + heading.size(), end == std::string::npos ? end : end + 1 - start - heading.size());
}

int replay(const ReplayFlags& flags) {
  const evaluator::log::Reader reader{flags.log};
  const auto sessions = reader.sessions();
  if (sessions.size() != 1) {
    throw std::runtime_error{fmt::format("{} holds {} sessions; a replay needs one", flags.log, sessions.size())};
  }
  hal::require_lockstep(sessions.front(), flags.log);
  const std::string config = reader.whole(sessions.front()).config_toml;
  const ConfigFile settings_file{section(config, "settings", flags.log)};
  const ConfigFile robot_file{section(config, "robot", flags.log)};
  config::Settings settings = config::load_settings(settings_file.path());
  settings.run.robot = robot_file.path().string();
  settings.hal.wheels = config::ReplayDevice{};
  settings.hal.kicker = config::ReplayDevice{};
  settings.hal.replay_log = flags.log;
  config::override_settings(settings, flags.overrides, "--set");
  return record_lockstep("replay_player", settings, flags.domain, flags.out);
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("replay", "Let the nodes decide a recorded match again, with other settings");
  verb->footer(
      "The log's sensor samples go through the same nodes; what they order moves nothing, so that decisions and\n"
      "receipts are the nodes', while ball and robot go on as recorded. The robot and the settings are those of\n"
      "the log, but for --set, e.g. --set 'kick_decision.policy_by_half=[\"moving\"]'.");
  auto flags = std::make_shared<ReplayFlags>();
  verb->add_option("log", flags->log, "match log of a lockstep match")->required();
  verb->add_option("--out", flags->out, "log of the replay, must not exist")->capture_default_str();
  verb->add_option("--set", flags->overrides, "one setting on top");
  verb->add_option("--domain", flags->domain, "DDS domain; default: drawn, with a discovery tag of its own")
      ->check(CLI::Range(0, 100));
  verb->callback([flags, &exit_code] { exit_code = replay(*flags); });
}

}  // namespace trivela::cli
