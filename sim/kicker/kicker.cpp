#include "sim/kicker/kicker.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::sim {

Kicker team_kicker(const Scenario& scenario, std::uint32_t robot) {
  Kicker kicker = scenario.kicker;
  const auto& ratios = scenario.team.speed_scale_ratios;
  if (!ratios.empty()) kicker.speed_scale_ratio *= ratios.at(robot - 1);
  return kicker;
}

Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed) {
  Kicker kicker = team_kicker(scenario, robot);
  const double drift =
      kicking::Draws{seed, 0}.normal(kicking::Role::kTeam, robot);  // opportunities count from 1: 0 is the match's own
  kicker.speed_scale_ratio *= std::max(0.5, 1.0 + kicker.drift_sd_ratio * drift);
  return kicker;
}

double worn_ratio(const Kicker& kicker, std::uint32_t kicks) {
  return kicks < kicker.drop_after_kicks ? 1.0 : 1.0 - kicker.drop_ratio;
}

Kicker kicker_of_kind(const Kicker& kicker, std::size_t kind) {
  Kicker of = kicker;
  if (kind == 0 || !kicker.flat.enabled) return of;
  of.powers = kicker.flat.powers;
  of.exit_speeds_mps = kicker.flat.exit_speeds_mps;
  of.exit_elevations_rad = kicker.flat.exit_elevations_rad;
  of.delay_s = kicker.flat.delay_s;
  of.delay_sd_s = kicker.flat.delay_sd_s;
  of.speed_sd_ratio = kicker.flat.speed_sd_ratio;
  of.direction_sd_rad = kicker.flat.direction_sd_rad;
  return of;
}

Exit exit_at(const Kicker& kicker, double power) {
  const auto& powers = kicker.powers;
  const auto above = std::upper_bound(powers.begin(), powers.end(), power);
  if (above == powers.begin()) return {kicker.exit_speeds_mps.front(), kicker.exit_elevations_rad.front()};
  if (above == powers.end()) return {kicker.exit_speeds_mps.back(), kicker.exit_elevations_rad.back()};
  const auto i = static_cast<std::size_t>(above - powers.begin());
  const double part = (power - powers[i - 1]) / (powers[i] - powers[i - 1]);
  return {std::lerp(kicker.exit_speeds_mps[i - 1], kicker.exit_speeds_mps[i], part),
          std::lerp(kicker.exit_elevations_rad[i - 1], kicker.exit_elevations_rad[i], part)};
}

Exit effective_exit(const Exit& true_exit, const BallPhysics& ball) {
  const double elevation = true_exit.elevation_rad;
  if (!(elevation > 0.0 && elevation < std::numbers::pi / 2) || !(true_exit.speed_mps > 0.0)) {
    throw std::runtime_error{
        fmt::format("no lob leaves at {} m/s and an elevation of {} rad", true_exit.speed_mps, elevation)};
  }
  // Far above the floor, so that it never bounces.
  BallMotion now{
      {{0.0, 0.0, 100.0}, {0.0, true_exit.speed_mps * std::cos(elevation), true_exit.speed_mps * std::sin(elevation)}}};
  const double launch_z = now.position_m.z();
  double apex = 0.0;
  constexpr double kFine_s = 1e-3;
  for (;;) {
    BallMotion next = now;
    advance(next, ball, kFine_s);
    if (now.velocity_mps.z() > 0.0 && next.velocity_mps.z() <= 0.0) {
      const double fraction = now.velocity_mps.z() / (now.velocity_mps.z() - next.velocity_mps.z());
      apex = now.position_m.z() - launch_z + 0.5 * now.velocity_mps.z() * fraction * kFine_s;
    }
    if (next.position_m.z() <= launch_z) {
      const double fraction = (now.position_m.z() - launch_z) / (now.position_m.z() - next.position_m.z());
      const double range = std::lerp(now.position_m.y(), next.position_m.y(), fraction);
      const double theta = std::atan(4.0 * apex / range);
      return {std::sqrt(range * ball.gravity_mps2 / std::sin(2.0 * theta)), theta};
    }
    now = next;
  }
}

Exit true_exit(const Exit& effective, const BallPhysics& ball) {
  Exit exit = effective;
  for (int i = 0; i < 20; ++i) {  // drag changes little: each round gains about a digit
    const Exit seen = effective_exit(exit, ball);
    exit.speed_mps *= effective.speed_mps / seen.speed_mps;
    exit.elevation_rad -= seen.elevation_rad - effective.elevation_rad;
  }
  return exit;
}

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
