#include "robot/observer/kick_learning.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr std::size_t kMostKicks = 16;  // whose outcome is open

template <class T>
void keep(std::deque<T>& all, const T& next) {
  all.push_back(next);
  if (all.size() > kMostKicks) all.pop_front();
}

/// The fields that a message and an estimate share.
void copy(const kicking::KickerEstimate& from, msg::KickerEstimate& to) {
  double* const means[] = {&to.speed_ln, &to.elevation_rad, &to.direction_rad,
                           &to.delay_s,  &to.along_ratio,   &to.sideways_ratio};
  double* const errors[] = {&to.speed_ln_se, &to.elevation_se_rad, &to.direction_se_rad,
                            &to.delay_se_s,  &to.along_se_ratio,   &to.sideways_se_ratio};
  for (Eigen::Index i = 0; i < kicking::kKickerParts; ++i) {
    *means[i] = from.mean[i];
    *errors[i] = from.se[i];
  }
  to.speed_sd_ratio = from.speed_sd_ratio;
  to.elevation_sd_rad = from.elevation_sd_rad;
  to.direction_sd_rad = from.direction_sd_rad;
  to.delay_sd_s = from.delay_sd_s;
  to.kicks = from.kicks;
  to.p_mistaken = from.p_mistaken;
  to.p_jump = from.p_jump;
  to.chi_square = from.chi_square;
}

}  // namespace

kicking::KickerEstimate estimate_of(const msg::KickerEstimate& message) {
  kicking::KickerEstimate estimate;
  estimate.mean << message.speed_ln, message.elevation_rad, message.direction_rad, message.delay_s, message.along_ratio,
      message.sideways_ratio;
  estimate.se << message.speed_ln_se, message.elevation_se_rad, message.direction_se_rad, message.delay_se_s,
      message.along_se_ratio, message.sideways_se_ratio;
  estimate.speed_sd_ratio = message.speed_sd_ratio;
  estimate.elevation_sd_rad = message.elevation_sd_rad;
  estimate.direction_sd_rad = message.direction_sd_rad;
  estimate.delay_sd_s = message.delay_sd_s;
  estimate.kicks = message.kicks;
  estimate.p_mistaken = message.p_mistaken;
  estimate.p_jump = message.p_jump;
  estimate.chi_square = message.chi_square;
  return estimate;
}

KickLearning::KickLearning(const config::SelfCalibration& settings, const kicking::RobotModel& model,
                           std::uint8_t robot_id)
    : learner_(model, settings.change) {
  message_.robot_id = robot_id;
  message_.seq = 1;
  message_.used = settings.mode == config::SelfCalibrationMode::kOn;
  copy(learner_.estimate(), message_);
}

void KickLearning::begin_with(const kicking::KickerEstimate& earlier) {
  learner_.begin_with(earlier);
  copy(learner_.estimate(), message_);
}

void KickLearning::receive(const msg::KickDecision& decision) {
  if (decision.fire) keep(decisions_, decision);
}

void KickLearning::receive(const msg::KickReceipt& receipt) {
  if (receipt.accepted) keep(receipts_, receipt);
}

std::optional<msg::KickerEstimate> KickLearning::seen(const msg::KickOutcome& outcome, std::int64_t t_ns) {
  const auto decision = std::ranges::find(decisions_, outcome.kick_id, &msg::KickDecision::kick_id);
  const auto receipt = std::ranges::find(receipts_, outcome.kick_id, &msg::KickReceipt::kick_id);
  const kicking::OptionalDouble speed_mps = outcome.flight_speed_mps;
  if (decision == decisions_.end() || receipt == receipts_.end() || !speed_mps) return std::nullopt;
  if (receipt->kick_kind != 0) return std::nullopt;  // a ball on the floor shows neither its speed nor its angle
  const kicking::Twist twist{decision->vx_mps, decision->vy_mps, decision->omega_radps};
  const bool learned =
      learner_.learn({.power = receipt->power,
                      .release = kicking::advance({decision->x_m, decision->y_m, decision->heading_rad}, twist,
                                                  kicking::seconds(receipt->release_t_ns - decision->t_ns)),
                      .twist = twist,
                      .speed_mps = *speed_mps,
                      .elevation_rad = outcome.flight_elevation_rad,
                      .direction_rad = outcome.flight_direction_rad,
                      .sd_mps = outcome.flight_sd_mps,
                      .late_s = outcome.release_late_s});
  decisions_.erase(decision);  // a second outcome of the same kick says nothing new
  if (!learned) return std::nullopt;
  copy(learner_.estimate(), message_);
  ++message_.seq;
  message_.t_ns = t_ns;
  message_.kick_id = outcome.kick_id;
  return message_;
}

}  // namespace trivela::robot
