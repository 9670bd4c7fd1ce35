#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kicking/geometry/frames.hpp"

namespace trivela::kicking {

/// An omnidirectional base: wheel i sits at wheel_angles_rad[i], counter-clockwise from +x of R, and drives along the
/// counter-clockwise tangent. Defaults: three wheels, two in front and one behind (an assumption; no published
/// geometry).
struct WheelBase {
  std::vector<double> wheel_angles_rad{0.5235987755982988, 2.6179938779914944, 4.71238898038469};
  double wheel_distance_m = 0.22;
  double wheel_radius_m = 0.05;

  bool operator==(const WheelBase&) const = default;
};

/// Between wheel speeds and the body's twist, for 3 or 4 wheels.
///
///     wheel_radius w_i = -sin(angle_i) vx + cos(angle_i) vy + wheel_distance omega        (rad/s, m/s)
///
/// The twist is the least-squares solution, so a fourth wheel averages noise.
class OmniKinematics {
 public:
  /// Throws std::invalid_argument unless the base has 3 or 4 wheels, positive lengths and spans the plane.
  explicit OmniKinematics(const WheelBase& base);

  int wheel_count() const { return static_cast<int>(backward_.cols()); }

  /// Body twist in R of the first wheel_count() speeds.
  Twist twist(std::span<const double> wheel_radps) const;

  /// Speeds of the wheels that give the twist [rad/s]; those beyond wheel_count() are 0.
  std::array<double, 4> wheel_speeds_radps(const Twist& twist) const;

  /// The twist at which `wheel`, counted from 0, turns with `radps` and no other does. None: others would, as always
  /// where there are four.
  std::optional<Twist> one_wheel(int wheel, double radps) const;

  /// Variances (vx, vy, omega) that independent wheel noise of standard deviation `wheel_sd_radps` leaves in twist().
  Eigen::Vector3d twist_variance(double wheel_sd_radps) const;

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 4, 3> forward_;   // twist -> wheel speeds
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4> backward_;  // wheel speeds -> twist, least squares
};

}  // namespace trivela::kicking
