#include <chrono>
#include <filesystem>
#include <optional>

#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::nodes {
namespace {

/// Length of a half; none: the scenario says it, and its file is not on this machine.
std::optional<double> minutes_of_half(const config::Settings& settings) {
  if (settings.simulator.half_minutes > 0.0) return settings.simulator.half_minutes;
  if (!std::filesystem::exists(settings.run.scenario)) return std::nullopt;
  return config::half_minutes(settings.simulator, config::load_scenario(settings.run.scenario));
}

}  // namespace

log::Simulation simulation_of(const config::Settings& settings) {
  const config::Simulator& simulator = settings.simulator;
  log::Simulation world{.seed = simulator.seed,
                        .scenario = std::filesystem::path{settings.run.scenario}.stem().string(),
                        .paired_halves = simulator.paired_halves};
  // A half that may end with its possessions has no length that anybody could know.
  if (simulator.max_possessions > 0) return world;
  const std::optional<double> minutes = minutes_of_half(settings);
  if (minutes) world.planned_s = simulator.halves * *minutes * 60.0;
  return world;
}

log::Session session_of(const NodeContext& context) {
  const config::Settings& settings = context.settings;
  // The bridge may be the simulator.
  const bool perhaps_simulated =
      settings.run.lockstep || std::holds_alternative<config::BusDevice>(settings.hal.wheels);
  log::Session session;
  session.simulated_clock = settings.run.lockstep;
  const std::int64_t realtime_ns = now_ns(std::chrono::system_clock::now());
  if (!session.simulated_clock) session.started_t_ns = now_ns(std::chrono::steady_clock::now());
  session.realtime_offset_ns = realtime_ns - session.started_t_ns;
  std::optional<sim::Scenario> scenario;
  if (perhaps_simulated && (settings.run.lockstep || std::filesystem::exists(settings.run.scenario))) {
    scenario = config::load_scenario(settings.run.scenario);  // in real time a robot records without a world's file
  }
  session.config_toml =
      robot::session_config(settings, {context.robot}, scenario ? config::to_toml_text(*scenario) : "");
  session.software_version = config::software_version();
  session.idl = robot::idl_text();
  const std::size_t by_half = settings.kick_decision.policy_by_half.size();
  session.policies = robot::session_policies(
      settings.kick_decision, perhaps_simulated ? settings.simulator.halves : std::max<std::size_t>(by_half, 2));
  return session;
}

}  // namespace trivela::nodes
