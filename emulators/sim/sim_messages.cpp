#include "emulators/sim/sim_messages.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

namespace trivela::hal {
namespace {

static_assert(bus::has_labels<msg::PossessionEnd>(sim::kPossessionEndNames));

constexpr sim::PlanPoint kNoPoint{msg::kNone, msg::kNone};

/// A match of more than four halves, which an experiment may have, has no names for them.
msg::GameStage stage_of(int half) {
  constexpr std::array kStages{msg::STAGE_FIRST_HALF, msg::STAGE_SECOND_HALF, msg::STAGE_FIRST_OVERTIME,
                               msg::STAGE_SECOND_OVERTIME};
  return half >= 1 && half <= static_cast<int>(kStages.size()) ? kStages[static_cast<std::size_t>(half) - 1]
                                                               : msg::STAGE_UNKNOWN;
}

}  // namespace

msg::DeviceWheels wheels_message(const sim::Sensors& sensors) {
  msg::DeviceWheels out{};
  out.t_ns = sensors.t_ns;
  out.wheel_count = static_cast<std::uint8_t>(sensors.wheels.wheel_count);
  std::copy(sensors.wheels.wheel_radps.begin(), sensors.wheels.wheel_radps.end(), out.wheel_radps);
  out.gyro_radps = sensors.wheels.gyro_radps;
  out.emulated = true;
  return out;
}

msg::DeviceKicker kicker_message(const sim::Sensors& sensors) {
  msg::DeviceKicker out{};
  out.t_ns = sensors.t_ns;
  out.charge = sensors.kicker.charge;
  out.armed = sensors.kicker.armed;
  out.fault = msg::FAULT_NONE;
  out.voltage_v = msg::kNone;
  out.emulated = true;
  out.lever = sensors.kicker.lever;
  out.lever_kind = sensors.kicker.lever_kind;
  return out;
}

msg::VisionFrame vision_message(std::int64_t t_ns, const sim::VisionFrame& frame) {
  msg::VisionFrame out{};
  out.t_ns = t_ns;
  out.t_exposure_ns = frame.t_exposure_ns;
  out.pose_seen = frame.pose.has_value();
  const auto pose = frame.pose.value_or(kicking::Pose{msg::kNone, msg::kNone, msg::kNone});
  out.x_m = pose.x_m;
  out.y_m = pose.y_m;
  out.heading_rad = pose.heading_rad;
  out.ball_seen = frame.ball.has_value();
  const auto ball = frame.ball.value_or(kNoPoint);
  out.ball_x_m = ball.x_m;
  out.ball_y_m = ball.y_m;
  out.opponent_seen = frame.opponent.has_value();
  const auto opponent = frame.opponent.value_or(kNoPoint);
  out.opponent_x_m = opponent.x_m;
  out.opponent_y_m = opponent.y_m;
  out.further_count = static_cast<std::uint8_t>(frame.further_count);
  for (std::size_t i = 0; i < sim::kMostFurther; ++i) {
    out.further_x_m[i] = i < frame.further_count ? frame.further[i].x_m : msg::kNone;
    out.further_y_m[i] = i < frame.further_count ? frame.further[i].y_m : msg::kNone;
  }
  out.keeper_seen = frame.keeper.has_value();
  const auto keeper = frame.keeper.value_or(kNoPoint);
  out.keeper_x_m = keeper.x_m;
  out.keeper_y_m = keeper.y_m;
  return out;
}

msg::FlightFrame flight_message(std::int64_t t_ns, const sim::FlightFrame& frame) {
  msg::FlightFrame out{};
  out.t_ns = t_ns;
  out.t_exposure_ns = frame.t_exposure_ns;
  out.ball_seen = frame.ball.has_value();
  const auto ball = frame.ball.value_or(sim::FlightFrame::Point{msg::kNone, msg::kNone, msg::kNone});
  out.ball_x_m = ball.x_m;
  out.ball_y_m = ball.y_m;
  out.ball_z_m = ball.z_m;
  return out;
}

msg::Referee referee_message(std::int64_t t_ns, const sim::RefereeState& word) {
  msg::Referee out{};
  out.t_ns = t_ns;
  out.half = static_cast<std::uint8_t>(word.half);
  out.playing = word.playing;
  out.possession_id = word.possession_id;
  out.stage = stage_of(word.half);
  if (word.set_piece) out.restart = word.possession_id == 1 ? msg::RESTART_KICKOFF : msg::RESTART_FREEKICK;
  out.ours = word.set_piece;
  out.goals_own =
      static_cast<std::uint16_t>(std::min(word.goals, std::uint32_t{std::numeric_limits<std::uint16_t>::max()}));
  out.command_counter = word.commands;
  out.half_time_s = word.half_s.to_message();
  return out;
}

msg::SimScan scan_message(const kicking::lob::Scan& scan, const kicking::lob::ScanGeometry& geometry) {
  msg::SimScan out{};
  out.t_ns = scan.t_ns;
  out.beam_count = static_cast<std::uint16_t>(std::min(scan.range_mm.size(), std::size(out.range_mm)));
  out.first_angle_rad = geometry.first_angle_rad;
  out.step_rad = geometry.step_rad;
  out.beam_period_s = geometry.beam_period_s;
  out.scan_period_s = geometry.scan_period_s;
  out.min_range_m = geometry.min_range_m;
  out.max_range_m = geometry.max_range_m;
  for (std::size_t i = 0; i < out.beam_count; ++i)
    out.range_mm[i] = static_cast<std::uint16_t>(std::min<std::uint32_t>(scan.range_mm[i], 0xffff));
  return out;
}

msg::KickTruth truth_message(const sim::KickTruth& truth) {
  msg::KickTruth out{};
  out.t_ns = truth.t_ns;
  out.kick_id = truth.kick_id;
  out.half = static_cast<std::uint8_t>(truth.half);
  out.possession_id = truth.possession_id;
  out.outcome = static_cast<msg::Outcome>(truth.outcome);
  const auto crossing = truth.crossing.value_or(sim::Crossing{msg::kNone, msg::kNone});
  out.x_cross_m = crossing.x_m;
  out.z_cross_m = crossing.z_m;
  out.release_t_ns = truth.release_t_ns;
  out.release_x_m = truth.release_position_m.x();
  out.release_y_m = truth.release_position_m.y();
  out.release_vx_mps = truth.release_velocity_mps.x();
  out.release_vy_mps = truth.release_velocity_mps.y();
  out.release_vz_mps = truth.release_velocity_mps.z();
  out.margin_m = truth.margin_m.to_message();
  out.saved = truth.saved;
  out.bounced = truth.bounced;
  return out;
}

msg::PossessionTruth possession_message(const sim::PossessionTruth& truth) {
  msg::PossessionTruth out{};
  out.t_ns = truth.t_ns;
  out.half = static_cast<std::uint8_t>(truth.half);
  out.possession_id = truth.possession_id;
  out.ending = static_cast<msg::PossessionEnd>(truth.ending);
  out.start_t_ns = truth.start_t_ns;
  out.start_x_m = truth.start.x_m;
  out.start_y_m = truth.start.y_m;
  out.start_heading_rad = truth.start.heading_rad;
  return out;
}

}  // namespace trivela::hal
