#include <chrono>
#include <filesystem>
#include <optional>

#include "config/installation.hpp"
#include "config/scenario.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/log/row.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/decision/assignment.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::nodes {
namespace {

using evaluator::log::Session;

/// Who a replay replays, and how long that was.
void describe_replay(const config::Hal& hal, Session& session) {
  const std::filesystem::path log{hal.replay_log};
  session.scenario = "replay of " + log.filename().string();
  const evaluator::log::Reader reader{log, evaluator::log::Check::kQuick};  // hal::ReplayLog looks at every row
  const auto sessions = reader.sessions();
  if (sessions.size() != 1) return;  // nor does the replay find out which
  session.replays_uuid = sessions.front().uuid;
  session.paired_halves = sessions.front().paired_halves;
  session.simulated = sessions.front().simulated;
  reader.query("SELECT 1e-9 * (max(t_ns) - min(t_ns)) FROM referee",
               [&](std::optional<double> planned_s) { session.planned_s = planned_s; });
}

/// The policies of the halves, and of the robots that have one of their own.
std::vector<evaluator::log::HalfPolicy> policies_of(const config::KickDecision& settings, std::size_t halves) {
  std::vector<evaluator::log::HalfPolicy> policies;
  if (!settings.random.empty()) return policies;
  for (std::size_t robot_id = 0; robot_id <= settings.policy_by_robot.size(); ++robot_id) {
    const robot::PolicyAssignment assignment{settings, static_cast<std::uint8_t>(robot_id)};
    for (std::size_t half = 1; half <= halves; ++half) {
      const auto policy = assignment.in_charge(static_cast<std::uint8_t>(half), 0).policy;
      policies.push_back({static_cast<int>(half), kicking::name(policy), static_cast<int>(robot_id)});
    }
  }
  return policies;
}

/// Length of a half; none: the scenario says it, and its file is not on this machine.
std::optional<double> minutes_of_half(const config::Settings& settings) {
  if (settings.simulator.half_minutes > 0.0) return settings.simulator.half_minutes;
  if (!std::filesystem::exists(settings.run.scenario)) return std::nullopt;
  return config::half_minutes(settings.simulator, config::load_scenario(settings.run.scenario));
}

}  // namespace

evaluator::log::Simulation simulation_of(const config::Settings& settings) {
  const config::Simulator& simulator = settings.simulator;
  evaluator::log::Simulation world{.seed = simulator.seed,
                                   .scenario = std::filesystem::path{settings.run.scenario}.stem().string(),
                                   .paired_halves = simulator.paired_halves};
  // A half that may end with its possessions has no length that anybody could know.
  if (simulator.max_possessions > 0) return world;
  const std::optional<double> minutes = minutes_of_half(settings);
  if (minutes) world.planned_s = simulator.halves * *minutes * 60.0;
  return world;
}

Session session_of(const NodeContext& context) {
  const config::Settings& settings = context.settings;
  // The bridge may be the simulator.
  const bool perhaps_simulated =
      settings.run.lockstep || std::holds_alternative<config::BusDevice>(settings.hal.wheels);
  Session session;
  session.simulated_clock = settings.run.lockstep;
  const std::int64_t realtime_ns = now_ns(std::chrono::system_clock::now());
  if (!session.simulated_clock) session.started_t_ns = now_ns(std::chrono::steady_clock::now());
  session.realtime_offset_ns = realtime_ns - session.started_t_ns;
  std::optional<sim::Scenario> scenario;
  if (std::holds_alternative<config::ReplayDevice>(settings.hal.wheels)) {
    describe_replay(settings.hal, session);
  } else if (perhaps_simulated && (settings.run.lockstep || std::filesystem::exists(settings.run.scenario))) {
    scenario = config::load_scenario(settings.run.scenario);  // in real time a robot records without a world's file
  }
  session.config_toml =
      robot::session_config(settings, {context.robot}, scenario ? config::to_toml_text(*scenario) : "");
  session.software_version = config::software_version();
  session.idl = robot::idl_text();
  const std::size_t by_half = settings.kick_decision.policy_by_half.size();
  session.policies = policies_of(settings.kick_decision,
                                 perhaps_simulated ? settings.simulator.halves : std::max<std::size_t>(by_half, 2));
  return session;
}

}  // namespace trivela::nodes
