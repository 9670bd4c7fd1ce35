#include "kicking/alignment/alignment.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::kicking {

double alpha_paper_rad(double vx_mps, double slope_rad_per_mps) { return slope_rad_per_mps * vx_mps; }

double alpha_atan_rad(double vx_mps, double distance_m, double time_s) {
  return std::atan(vx_mps * time_s / distance_m);
}

double alpha_physical_rad(double v_kick_mps, const Elevation& exit_angle, const Transfer& transfer, const Twist& twist,
                          double ball_offset_m) {
  return std::atan2(transfer.lateral * (twist.vx_mps - twist.omega_radps * ball_offset_m),
                    v_kick_mps * exit_angle.cosine + transfer.along_mps(twist.vy_mps));
}

double beta_paper_rad(double omega_radps, double slope_s) { return slope_s * omega_radps; }

double beta_physical_rad(double omega_radps, double delay_s, double ball_offset_m, double v_h_mps) {
  return omega_radps * delay_s + std::atan(omega_radps * ball_offset_m / v_h_mps);
}

namespace {

constexpr double kTouch_m = 1e-9;  // ends of S2 are inclusive, rounding included

}  // namespace

Alignment align(const Pose& robot, double alpha_rad, double beta_rad, double omega_radps,
                const Eigen::Vector2d& target_m, const AlignmentRule& rule) {
  const Eigen::Vector2d line = target_m - Eigen::Vector2d(robot.x_m, robot.y_m);
  const double d = line.norm();
  const double w = rule.half_width_m;
  Alignment result{false, d, std::nullopt, w, w};

  const double lead = d * std::tan(std::min(std::abs(beta_rad), rule.beta_limit_rad));
  const double extended = rule.extension == Extension::kMax ? std::max(w, lead) : w + lead;
  if (omega_radps > 0.0) result.right_m = extended;
  if (omega_radps < 0.0) result.left_m = extended;

  if (!(d >= kTouch_m)) return result;
  const Eigen::Vector2d t = line / d;
  const Eigen::Vector2d u = direction(robot.heading_rad - alpha_rad);
  const double c = u.dot(t);
  const double q = u.x() * t.y() - u.y() * t.x();
  if (!(c > 0.0 && d / c <= rule.reach_m)) return result;
  const double s = d * q / c;
  result.offset_right_m = s;
  result.aligned = -result.left_m - kTouch_m <= s && s <= result.right_m + kTouch_m;
  return result;
}

}  // namespace trivela::kicking
