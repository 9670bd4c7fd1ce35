#include "sim/kicker/kicker_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/model/robot_model.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::sim {

KickerDevice::KickerDevice(const Kicker& values) : values_(values), flat_(kicker_of_kind(values, 1)) {}

void KickerDevice::reset(double speed_scale_ratio) {
  values_.speed_scale_ratio = flat_.speed_scale_ratio = speed_scale_ratio;
  lever_from_ = lever_to_ = 0;
  lever_stands_t_ns_ = 0;
  charge_ = 1.0;
  order_.reset();
  stroke_.reset();
}

void KickerDevice::order(const Fire& fire) {
  if (order_ || stroke_ || !std::isfinite(fire.power)) return;
  order_ = fire;
}

void KickerDevice::lever(std::uint8_t kind, std::int64_t t_ns) {
  if (kind == lever_to_ || t_ns < lever_stands_t_ns_ || kind > (values_.flat.enabled ? 1 : 0)) return;
  lever_from_ = lever_to_;
  lever_to_ = kind;
  lever_stands_t_ns_ = t_ns + kicking::nanoseconds(values_.flat.lever_s);
}

std::uint8_t KickerDevice::lever_kind(std::int64_t t_ns) const {
  return t_ns >= lever_stands_t_ns_ ? lever_to_ : kicking::kLeverMoves;
}

std::optional<std::int64_t> KickerDevice::next_event_t_ns() const {
  if (order_) return order_->t_ns;
  if (stroke_) return stroke_->release_t_ns;
  return std::nullopt;
}

void KickerDevice::energise_due(std::int64_t t_ns, bool live, const kicking::Draws& draws, std::uint32_t attempt) {
  if (!order_ || order_->t_ns > t_ns) return;
  const bool flat = (t_ns >= lever_stands_t_ns_ ? lever_to_ : lever_from_) != 0;
  const Kicker& values = flat ? flat_ : values_;
  const Exit exit = exit_at(values, order_->power);
  const double relative = exit.speed_mps / values.exit_speeds_mps.back();
  const double needed = values.charge_per_kick_ratio * relative * relative;
  const double strength = charge_ >= needed ? 1.0 : std::sqrt(charge_ / needed);
  charge_ = std::max(0.0, charge_ - needed);

  const auto [speed_noise, direction_noise, delay_noise, spare] = draws.normals(kicking::Role::kKicker, attempt);
  const double delay_s = std::max(0.0, values.delay_s + values.delay_sd_s * delay_noise);
  stroke_ = Stroke{.kick_id = order_->kick_id,
                   .release_t_ns = t_ns + kicking::nanoseconds(delay_s),
                   .exit_speed_mps = std::max(0.0, exit.speed_mps * strength * values.speed_scale_ratio *
                                                       (1.0 + values.speed_sd_ratio * speed_noise)),
                   .exit_elevation_rad = exit.elevation_rad,
                   .deflection_rad = values.direction_sd_rad * direction_noise,
                   .live = live};
  order_.reset();
}

std::optional<Stroke> KickerDevice::take_released(std::int64_t t_ns) {
  if (!stroke_ || stroke_->release_t_ns > t_ns) return std::nullopt;
  return std::exchange(stroke_, std::nullopt);
}

void KickerDevice::recharge(double dt_s) { charge_ = std::min(1.0, charge_ + values_.recharge_per_s * dt_s); }

BallMotion release(const Stroke& stroke, const kicking::Pose& pose, const kicking::Twist& twist, const Kicker& kicker,
                   double ball_offset_m, double radius_m) {
  const double horizontal = stroke.exit_speed_mps * std::cos(stroke.exit_elevation_rad);
  const double forward_ratio = twist.vy_mps < 0.0 ? kicker.transfer_backward_ratio : kicker.transfer_forward_ratio;
  // In R: the ball's point is (0, ball_offset), so omega x r = (-omega ball_offset, 0).
  const double right = -horizontal * std::sin(stroke.deflection_rad) +
                       kicker.transfer_lateral_ratio * (twist.vx_mps - twist.omega_radps * ball_offset_m);
  const double forward = horizontal * std::cos(stroke.deflection_rad) + forward_ratio * twist.vy_mps;
  const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
  return {{{pose.x_m - s * ball_offset_m, pose.y_m + c * ball_offset_m, radius_m},
           {c * right - s * forward, s * right + c * forward,
            stroke.exit_speed_mps * std::sin(stroke.exit_elevation_rad)}}};
}

}  // namespace trivela::sim
