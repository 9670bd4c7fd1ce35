#include <chrono>
#include <filesystem>

#include "config/scenario.hpp"
#include "idl_text.hpp"
#include "nodes/recorder/recorder_node.hpp"

namespace trivela::nodes {
namespace {

std::int64_t now_ns(auto clock_now) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(clock_now.time_since_epoch()).count();
}

/// The settings without what differs from run to run and from machine to machine, so that equal set-ups have equal
/// hashes; robot and scenario follow in full.
config::Settings set_up(config::Settings settings) {
  settings.domain.domain_id = config::Domain{}.domain_id;
  settings.domain.tag = config::Domain{}.tag;
  settings.recorder.log = config::Recorder{}.log;
  settings.scan_recorder.file = config::ScanRecorder{}.file;
  settings.run.robot = config::Run{}.robot;
  settings.run.scenario = config::Run{}.scenario;
  settings.run.log_level = config::Run{}.log_level;
  settings.hal.replay_log = std::filesystem::path{settings.hal.replay_log}.filename().string();
  return settings;
}

}  // namespace

evaluator::log::Session session_of(const NodeContext& context) {
  const config::Settings& settings = context.settings;
  const bool simulated = settings.run.lockstep || settings.hal.wheels == "sim";
  evaluator::log::Session session;
  session.simulated = simulated;
  session.simulated_clock = simulated;
  const std::int64_t realtime_ns = now_ns(std::chrono::system_clock::now());
  if (!simulated) session.started_t_ns = now_ns(std::chrono::steady_clock::now());
  session.realtime_offset_ns = realtime_ns - session.started_t_ns;
  session.config_toml =
      "### settings\n" + config::to_toml_text(set_up(settings)) + "\n### robot\n" + config::to_toml_text(context.robot);
  if (settings.hal.wheels == "replay") {
    session.scenario = "replay of " + std::filesystem::path{settings.hal.replay_log}.filename().string();
  } else if (simulated) {
    session.seed = settings.simulator.seed;
    session.scenario = std::filesystem::path{settings.run.scenario}.stem().string();
    session.config_toml += "\n### scenario\n" + config::to_toml_text(config::load_scenario(settings.run.scenario));
  }
  session.software_version = TRIVELA_VERSION;
  session.idl = kIdlText;
  const auto& by_half = settings.kick_decision.policy_by_half;
  const std::size_t halves = simulated ? settings.simulator.halves : std::max<std::size_t>(by_half.size(), 2);
  for (std::size_t half = 1; half <= halves; ++half) {
    const auto policy = by_half[std::min(half, by_half.size()) - 1];
    session.policies.push_back({static_cast<int>(half), kicking::name(policy)});
  }
  return session;
}

}  // namespace trivela::nodes
