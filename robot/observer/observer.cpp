#include "robot/observer/observer.hpp"

#include <cmath>
#include <iterator>
#include <tuple>

namespace trivela::robot {
namespace {

static_assert(bus::has_labels<msg::Outcome>(kicking::kOutcomeNames));

msg::KickOutcome message(const TrackedShot& shot) {
  msg::KickOutcome out{};
  out.t_ns = shot.t_ns;
  out.kick_id = shot.kick_id;
  out.outcome = static_cast<msg::Outcome>(shot.verdict.outcome);
  out.on_target = shot.verdict.outcome == kicking::Outcome::kOnTarget;
  out.x_cross_m = shot.verdict.x_cross_m.to_message();
  out.z_cross_m = shot.verdict.z_cross_m.to_message();
  out.sd_cross_m = shot.verdict.sd_cross_m.to_message();
  out.observations = static_cast<std::uint32_t>(shot.sightings);
  out.exit_speed_mps = shot.verdict.exit_speed_mps.to_message();
  out.exit_elevation_rad = shot.verdict.exit_elevation_rad.to_message();
  const auto& parabola = shot.verdict.parabola;
  out.flight_speed_mps = parabola ? parabola->speed_mps : msg::kNone;
  out.flight_elevation_rad = parabola ? parabola->elevation_rad : msg::kNone;
  out.flight_direction_rad = parabola ? parabola->direction_rad : msg::kNone;
  out.flight_sd_mps = parabola ? parabola->sd_mps : msg::kNone;
  double* const probabilities[] = {&out.p_on_target, &out.p_wide_left, &out.p_wide_right, &out.p_over,
                                   &out.p_short,     &out.p_post,      &out.p_bar,        &out.p_blocked};
  static_assert(std::size(probabilities) == std::tuple_size_v<kicking::OutcomeProbabilities>);
  for (std::size_t i = 0; i < std::size(probabilities); ++i)
    *probabilities[i] = shot.verdict.probabilities ? (*shot.verdict.probabilities)[i] : msg::kNone;
  out.bounced = shot.verdict.bounced;
  out.residual_sd_m = shot.verdict.residual_sd_m.to_message();
  out.release_late_s = shot.verdict.release_late_s.to_message();
  out.p_saved = shot.verdict.p_saved.to_message();
  return out;
}

void append(std::vector<msg::KickOutcome>& outcomes, const std::vector<TrackedShot>& settled) {
  for (const TrackedShot& shot : settled) outcomes.push_back(message(shot));
}

}  // namespace

std::vector<msg::KickOutcome> Observer::receipt(const msg::KickReceipt& receipt, const kicking::RobotModel& model) {
  std::vector<msg::KickOutcome> outcomes;
  if (!msg::begins_kick(receipt)) return outcomes;
  const kicking::RobotModel& kind = model.kind(receipt.kick_kind < model.kinds() ? receipt.kick_kind : 0);
  const double v_mps = kind.table.speed_for(receipt.power), angle_rad = kind.exit_angle_at(receipt.power);
  append(outcomes, tracker_.release(receipt.kick_id, receipt.release_t_ns, v_mps * std::cos(angle_rad),
                                    v_mps * std::sin(angle_rad)));
  return outcomes;
}

std::vector<msg::KickOutcome> Observer::frame(const msg::FlightFrame& frame,
                                              const std::optional<msg::Referee>& referee) {
  if (!referee || referee->playing) {
    stopped_t_ns_.reset();
  } else if (!stopped_t_ns_) {
    stopped_t_ns_ = referee->t_ns;
  }
  std::vector<msg::KickOutcome> outcomes;
  if (stopped_t_ns_ && frame.t_exposure_ns >= *stopped_t_ns_) append(outcomes, tracker_.stopped(*stopped_t_ns_));
  const Eigen::Vector3d ball_m{frame.ball_x_m, frame.ball_y_m, frame.ball_z_m};
  append(outcomes, tracker_.frame(frame.t_exposure_ns, frame.ball_seen ? std::optional{ball_m} : std::nullopt));
  return outcomes;
}

}  // namespace trivela::robot
