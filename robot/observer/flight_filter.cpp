#include "robot/observer/flight_filter.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/constants.hpp"

namespace trivela::robot {
namespace {

const kicking::Ball kBall{};
const double kDrag_per_m = kicking::drag_per_m(kBall, {});
constexpr double kDragDoubt = 0.5;
constexpr double kRestitution = 0.65, kRetention = 0.8;  // assumptions: 0.6 to 0.75 on carpet; flights on grass
constexpr double kBounceDoubt = 0.1;                     // of either
constexpr double kSoft_mps = 1.0;                        // a softer bounce takes less of the horizontal speed
constexpr double kRollBelow_mps = 0.3;
constexpr double kRolling_mps2 = 0.5, kRollingDoubt_mps2 = 0.3;  // deceleration; assumption
constexpr double kSliding_mps2 = 2.5, kSlidingDoubt_mps2 = 2.5;  // the same of a low kick; friction of 0 to 0.4
constexpr double kOnFloor_m = 0.02;                              // standard deviation of a rolling ball's height

void predict(AxisState& s, double dt_s, double acceleration_mps2, double doubt_mps2) {
  s.p_m += dt_s * (s.v_mps + 0.5 * acceleration_mps2 * dt_s);
  s.v_mps += acceleration_mps2 * dt_s;
  s.var_p_m2 += dt_s * (2.0 * s.cov_m2ps + dt_s * s.var_v_m2ps2);
  s.cov_m2ps += dt_s * s.var_v_m2ps2;
  // A steady doubt of the acceleration over half a second, as white noise.
  s.var_v_m2ps2 += 0.5 * doubt_mps2 * doubt_mps2 * dt_s;
}

double correct_axis(AxisState& s, double seen_m, double var_m2, double& variance_m2) {
  variance_m2 = s.var_p_m2 + var_m2;
  const double innovation = seen_m - s.p_m, gain = s.var_p_m2 / variance_m2, gain_v = s.cov_m2ps / variance_m2;
  s.p_m += gain * innovation;
  s.v_mps += gain_v * innovation;
  s.var_v_m2ps2 -= gain_v * s.cov_m2ps;
  s.cov_m2ps *= 1.0 - gain;
  s.var_p_m2 *= 1.0 - gain;
  return innovation * innovation / variance_m2;
}

void keep(AxisState& s, double ratio, double sd) {
  s.cov_m2ps *= ratio;
  s.var_v_m2ps2 = ratio * ratio * s.var_v_m2ps2 + sd * sd * s.v_mps * s.v_mps;
  s.v_mps *= ratio;
}

}  // namespace

FlightFilter::FlightFilter(const kicking::Sighting& first, double ball_sd_m, const Eigen::Vector3d& velocity_mps,
                           const Eigen::Vector3d& sd_mps, Way way)
    : rolling_(way != Way::kFlies), slides_(way == Way::kSlides), bounced_(slides_) {
  AxisState* const axes[] = {&x_, &y_, &z_};
  for (int i = 0; i < 3; ++i)
    *axes[i] = {first.ball_m[i], velocity_mps[i], ball_sd_m * ball_sd_m, 0.0, sd_mps[i] * sd_mps[i]};
  if (rolling_) z_ = {kBall.radius_m, 0.0, kOnFloor_m * kOnFloor_m, 0.0, 0.0};
}

double FlightFilter::speed_mps() const { return std::sqrt(x_.v_mps * x_.v_mps + y_.v_mps * y_.v_mps); }

void FlightFilter::advance(double dt_s) {
  for (int bounces = 0; dt_s > 0.0; ++bounces) {
    if (rolling_) return roll(dt_s);
    const double down_mps2 = kicking::kGravity_mps2, above_m = z_.p_m - kBall.radius_m;
    const double root = z_.v_mps * z_.v_mps + 2.0 * down_mps2 * above_m;
    const double lands_s = root > 0.0 ? (z_.v_mps + std::sqrt(root)) / down_mps2 : z_.v_mps < 0.0 ? 0.0 : dt_s;
    if (lands_s >= dt_s) return fly(dt_s);
    if (lands_s > 0.0) fly(lands_s);
    dt_s -= std::max(0.0, lands_s);
    if (bounces < 4) {
      bounce();
    } else {
      rolling_ = true;
    }
  }
}

void FlightFilter::fly(double dt_s) {
  const double speed = std::sqrt(x_.v_mps * x_.v_mps + y_.v_mps * y_.v_mps + z_.v_mps * z_.v_mps);
  const double k = kDrag_per_m * speed;
  predict(x_, dt_s, -k * x_.v_mps, kDragDoubt * k * x_.v_mps);
  predict(y_, dt_s, -k * y_.v_mps, kDragDoubt * k * y_.v_mps);
  predict(z_, dt_s, -k * z_.v_mps - kicking::kGravity_mps2, kDragDoubt * k * z_.v_mps);
}

void FlightFilter::roll(double dt_s) {
  const double speed = speed_mps();
  if (speed <= 0.0) return;
  const double deceleration = (slides_ ? kSliding_mps2 : kRolling_mps2) + kDrag_per_m * speed * speed;
  const double moves_s = std::min(dt_s, speed / deceleration);
  for (AxisState* const axis : {&x_, &y_}) {
    predict(*axis, moves_s, -deceleration * axis->v_mps / speed, slides_ ? kSlidingDoubt_mps2 : kRollingDoubt_mps2);
    if (moves_s < dt_s) axis->v_mps = 0.0;
  }
}

void FlightFilter::bounce() {
  bounced_ = true;
  const double down_mps = std::abs(z_.v_mps);
  const double hard = std::min(1.0, down_mps / kSoft_mps);
  for (AxisState* const axis : {&x_, &y_}) keep(*axis, 1.0 - (1.0 - kRetention) * hard, kBounceDoubt * hard);
  z_.p_m = kBall.radius_m;
  if (down_mps < kRollBelow_mps) {
    rolling_ = true;
    z_ = {kBall.radius_m, 0.0, kOnFloor_m * kOnFloor_m, 0.0, 0.0};
    return;
  }
  // A ball that is higher by d comes down later by d / |v|: it is then lower by e d and faster by (1 + e) g d / |v|.
  const double e = kRestitution, c = (1.0 + e) * kicking::kGravity_mps2 / std::max(1.0, down_mps);
  const AxisState before = z_;
  z_.v_mps = e * down_mps;
  z_.var_p_m2 = e * e * before.var_p_m2;
  z_.cov_m2ps = e * (e * before.cov_m2ps - c * before.var_p_m2);
  z_.var_v_m2ps2 = c * c * before.var_p_m2 - 2.0 * c * e * before.cov_m2ps + e * e * before.var_v_m2ps2 +
                   kBounceDoubt * kBounceDoubt * down_mps * down_mps;
}

std::array<double, 3> FlightFilter::correct(const Eigen::Vector3d& ball_m, double ball_sd_m) {
  const double var_m2 = ball_sd_m * ball_sd_m;
  double of_x = 1.0, of_y = 1.0, of_z = 1.0;
  const double x2 = correct_axis(x_, ball_m.x(), var_m2, of_x);
  const double y2 = correct_axis(y_, ball_m.y(), var_m2, of_y);
  const double z2 = correct_axis(z_, ball_m.z(), var_m2, of_z);
  log_variance_ = std::log(of_x * of_y);
  return {x2, y2, z2};
}

void FlightFilter::turn(const Eigen::Vector2d& mean_mps, double sd_mps, double dt_s) {
  int i = 0;
  for (AxisState* const axis : {&x_, &y_}) {
    axis->p_m += 0.5 * dt_s * mean_mps[i];
    axis->v_mps += mean_mps[i];
    // Half the interval on average; its spread, dt / sqrt(12), moves the ball by the mean's share of it as well.
    const double square = sd_mps * sd_mps + mean_mps[i] * mean_mps[i] / 4.0;
    axis->var_p_m2 += square * dt_s * dt_s / 3.0;
    axis->cov_m2ps += sd_mps * sd_mps * dt_s / 2.0;
    axis->var_v_m2ps2 += sd_mps * sd_mps;
    ++i;
  }
}

void FlightFilter::throw_back(double y_m, double ratio, double sd) {
  keep(x_, ratio, sd);
  keep(y_, -ratio, sd);
  keep(z_, ratio, sd);
  y_.p_m = y_m;
  y_.var_p_m2 *= ratio * ratio;
  y_.cov_m2ps *= -ratio;
}

}  // namespace trivela::robot
