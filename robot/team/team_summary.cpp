#include "robot/team/team_summary.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace trivela::robot {
namespace {

bool fresh(std::int64_t received_ns, std::int64_t now_ns) {
  return received_ns > 0 && now_ns - received_ns <= kAlarmSilence_ns;
}

template <class T>
const T* lately(const LatestSample<T>& last, std::int64_t now_ns) {
  return last.word && fresh(last.received_ns, now_ns) ? &*last.word : nullptr;
}

void raise(msg::TeamSummary& summary, Alarm alarm, bool so) {
  if (so) summary.alarms |= bit(alarm);
}

msg::TeamSummary nothing_known() {
  msg::TeamSummary summary{};
  summary.reason = msg::REASON_STALE_STATE;
  for (double* const number :
       {&summary.charge, &summary.x_m, &summary.y_m, &summary.heading_rad, &summary.vx_mps, &summary.vy_mps,
        &summary.omega_radps, &summary.ball_x_m, &summary.ball_y_m, &summary.ball_vx_mps, &summary.ball_vy_mps})
    *number = msg::kNone;
  return summary;
}

void describe_world(msg::TeamSummary& summary, const msg::WorldState& world) {
  summary.half = world.half;
  summary.playing = world.playing;
  summary.placed = std::isfinite(world.x_m) && std::isfinite(world.y_m) && std::isfinite(world.heading_rad);
  summary.ball_known = world.ball_known;
  summary.possession = world.possession;
  summary.x_m = world.x_m;
  summary.y_m = world.y_m;
  summary.heading_rad = world.heading_rad;
  summary.vx_mps = world.vx_mps;
  summary.vy_mps = world.vy_mps;
  summary.omega_radps = world.omega_radps;
  summary.ball_x_m = world.ball_x_m;
  summary.ball_y_m = world.ball_y_m;
  summary.ball_vx_mps = world.ball_vx_mps;
  summary.ball_vy_mps = world.ball_vy_mps;
}

}  // namespace

std::string alarm_words(std::uint32_t alarms) {
  constexpr std::array<std::pair<Alarm, std::string_view>, 6> kWords{{{Alarm::kWorldSilent, "world_state silent"},
                                                                      {Alarm::kVisionSilent, "vision silent"},
                                                                      {Alarm::kDecisionSilent, "kick_decision silent"},
                                                                      {Alarm::kKickerSilent, "kicker silent"},
                                                                      {Alarm::kKickerFault, "kicker fault"},
                                                                      {Alarm::kRefereeSilent, "referee silent"}}};
  std::string text;
  for (const auto& [alarm, word] : kWords) {
    if ((alarms & bit(alarm)) == 0) continue;
    alarms &= ~bit(alarm);
    text += fmt::format("{}{}", text.empty() ? "" : ", ", word);
  }
  if (alarms != 0) text += fmt::format("{}alarms {:#x}", text.empty() ? "" : ", ", alarms);
  return text;
}

msg::TeamSummary robot_summary(const TeamInputs& inputs, std::int64_t now_ns) {
  msg::TeamSummary summary = nothing_known();
  const auto* const world = lately(inputs.world, now_ns);
  const auto* const kicker = lately(inputs.kicker, now_ns);
  if (world != nullptr) describe_world(summary, *world);
  if (kicker != nullptr) {
    summary.kicker = kicker->state;
    summary.charge = kicker->charge;
  }
  if (inputs.decision.word) summary.policy = inputs.decision.word->policy;
  if (const auto* const decision = lately(inputs.decision, now_ns)) {
    summary.reason = decision->reason;
  } else if (world != nullptr) {
    summary.reason =
        world->playing ? msg::REASON_NO_BALL : msg::REASON_NOT_PLAYING;  // decisions are made with the ball
  }
  raise(summary, Alarm::kWorldSilent, world == nullptr);
  raise(summary, Alarm::kVisionSilent, !fresh(inputs.vision_received_ns, now_ns));
  raise(summary, Alarm::kDecisionSilent, !fresh(inputs.drive_received_ns, now_ns));
  raise(summary, Alarm::kKickerSilent, kicker == nullptr);
  raise(summary, Alarm::kKickerFault, kicker != nullptr && kicker->fault != msg::FAULT_NONE);
  raise(summary, Alarm::kRefereeSilent, !fresh(inputs.referee.received_ns, now_ns));
  return summary;
}

msg::TeamSummary base_summary(const LatestSample<msg::Referee>& referee, std::int64_t now_ns) {
  msg::TeamSummary summary = nothing_known();
  const auto* const word = lately(referee, now_ns);
  raise(summary, Alarm::kRefereeSilent, word == nullptr);
  if (word == nullptr) return summary;
  summary.half = word->half;
  summary.playing = word->playing;
  return summary;
}

std::optional<msg::WorldState> world_of(const msg::TeamHeard& received) {
  const msg::TeamSummary& summary = received.summary;
  if (!summary.placed) return std::nullopt;
  msg::WorldState world{};
  world.robot_id = received.other_robot_id;
  world.seq = received.seq;
  world.t_ns = received.t_ns;
  world.half = summary.half;
  world.playing = summary.playing;
  world.x_m = summary.x_m;
  world.y_m = summary.y_m;
  world.heading_rad = summary.heading_rad;
  world.vx_mps = summary.vx_mps;
  world.vy_mps = summary.vy_mps;
  world.omega_radps = summary.omega_radps;
  world.sd_position_m = world.sd_heading_rad = world.ball_age_s = world.opponent_distance_m = msg::kNone;
  world.ball_known = summary.ball_known;
  world.ball_x_m = summary.ball_x_m;
  world.ball_y_m = summary.ball_y_m;
  world.ball_vx_mps = summary.ball_vx_mps;
  world.ball_vy_mps = summary.ball_vy_mps;
  world.possession = summary.possession;
  return world;
}

}  // namespace trivela::robot
