#pragma once

#include <cstdint>
#include <cstring>

#include "idl/messages.hpp"

namespace trivela::pages {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Messages as a robot's nodes write them, with what a test cares for.
inline msg::KickDecision decision(std::uint8_t robot_id, std::int64_t kick_id, msg::Policy policy,
                                  std::uint64_t seq = 1, std::int64_t t_ns = kSecond_ns) {
  msg::KickDecision decision{};
  decision.robot_id = robot_id;
  decision.seq = seq;
  decision.t_ns = t_ns;
  decision.kick_id = kick_id;
  std::memcpy(&decision.policy, &policy, sizeof(policy));  // as it comes over the bus: it may be none
  decision.fire = kick_id != 0;
  decision.reason = kick_id != 0 ? msg::REASON_FIRE : msg::REASON_NOT_ALIGNED;
  decision.y_m = 4.0;
  decision.target_y_m = 9.0;
  decision.distance_m = 5.0;
  decision.power = 30.0;
  decision.p_on_target = msg::kNone;
  decision.offset_right_m = msg::kNone;
  return decision;
}

inline msg::KickReceipt receipt(std::uint8_t robot_id, std::int64_t kick_id, bool accepted, std::uint64_t seq = 1,
                                msg::Refusal refusal = msg::REFUSAL_NONE) {
  msg::KickReceipt receipt{};
  receipt.robot_id = robot_id;
  receipt.seq = seq;
  receipt.kick_id = kick_id;
  receipt.accepted = accepted;
  receipt.refusal = refusal;
  return receipt;
}

inline msg::KickOutcome outcome(std::uint8_t robot_id, std::int64_t kick_id, msg::Outcome what, std::uint64_t seq = 1) {
  msg::KickOutcome outcome{};
  outcome.robot_id = robot_id;
  outcome.seq = seq;
  outcome.kick_id = kick_id;
  outcome.outcome = what;
  outcome.on_target = what == msg::OUTCOME_ON_TARGET;
  outcome.x_cross_m = outcome.z_cross_m = msg::kNone;
  return outcome;
}

inline msg::WorldState world(std::uint8_t robot_id, std::uint64_t seq, bool playing = true, bool possession = false) {
  msg::WorldState world{};
  world.robot_id = robot_id;
  world.seq = seq;
  world.t_ns = static_cast<std::int64_t>(seq) * 20'000'000;
  world.playing = playing;
  world.possession = possession;
  world.x_m = 1.0;
  world.y_m = 4.0;
  world.heading_rad = 0.25;
  world.ball_known = possession;
  world.ball_x_m = possession ? 1.0 : msg::kNone;
  world.ball_y_m = possession ? 4.3 : msg::kNone;
  return world;
}

inline msg::Referee referee(std::uint8_t robot_id, std::uint64_t seq, bool playing = true) {
  msg::Referee word{};
  word.robot_id = robot_id;
  word.seq = seq;
  word.t_ns = static_cast<std::int64_t>(seq) * 20'000'000;
  word.half = 1;
  word.playing = playing;
  word.half_time_s = 12.4;
  return word;
}

inline msg::KickerStatus kicker(std::uint8_t robot_id, std::uint64_t seq, bool armed = true) {
  msg::KickerStatus status{};
  status.robot_id = robot_id;
  status.seq = seq;
  status.t_ns = static_cast<std::int64_t>(seq) * 20'000'000;
  status.state = armed ? msg::STATE_READY : msg::STATE_OFF;
  status.charge = 0.97;
  status.armed = status.ready = armed;
  return status;
}

}  // namespace trivela::pages
