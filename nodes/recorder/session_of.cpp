#include <chrono>
#include <filesystem>
#include <optional>

#include "config/scenario.hpp"
#include "nodes/kick_decision/assignment.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/recorder/session_text.hpp"
#include "nodes/runtime/now_ns.hpp"

namespace trivela::nodes {

evaluator::log::Session session_of(const NodeContext& context) {
  const config::Settings& settings = context.settings;
  const bool simulated = settings.run.lockstep || settings.hal.wheels == "sim";
  evaluator::log::Session session;
  session.simulated = simulated;
  session.simulated_clock = settings.run.lockstep;
  const std::int64_t realtime_ns = now_ns(std::chrono::system_clock::now());
  if (!session.simulated_clock) session.started_t_ns = now_ns(std::chrono::steady_clock::now());
  session.realtime_offset_ns = realtime_ns - session.started_t_ns;
  std::optional<sim::Scenario> scenario;
  if (settings.hal.wheels == "replay") {
    session.scenario = "replay of " + std::filesystem::path{settings.hal.replay_log}.filename().string();
  } else if (simulated) {
    session.seed = settings.simulator.seed;
    session.scenario = std::filesystem::path{settings.run.scenario}.stem().string();
    scenario = config::load_scenario(settings.run.scenario);
  }
  session.config_toml = session_config(settings, {context.robot}, scenario ? &*scenario : nullptr);
  session.software_version = software_version();
  session.idl = idl_text();
  const PolicyAssignment assignment{settings.kick_decision, context.robot_id()};
  if (assignment.random()) return session;
  const auto& by_half = settings.kick_decision.policy_by_half;
  const std::size_t halves = simulated ? settings.simulator.halves : std::max<std::size_t>(by_half.size(), 2);
  for (std::size_t half = 1; half <= halves; ++half) {
    const auto policy = assignment.in_charge(static_cast<std::uint8_t>(half), 0).policy;
    session.policies.push_back({static_cast<int>(half), kicking::name(policy)});
  }
  return session;
}

}  // namespace trivela::nodes
