#pragma once

#include <Eigen/Core>
#include <array>

#include "kicking/ballistics/flight.hpp"

namespace trivela::robot {

/// Place and speed along one axis, with what is not known of them.
struct AxisState {
  double p_m = 0.0;
  double v_mps = 0.0;
  double var_p_m2 = 0.0;
  double cov_m2ps = 0.0;
  double var_v_m2ps2 = 0.0;
};

/// Kalman filter of a free ball: drag a = -k |v| v, gravity, bounces and rolling.
///
/// A bounce keeps 0.65 +- 0.1 of the vertical speed and 0.8 +- 0.1 of the horizontal one (less is lost where the ball
/// comes down slower than 1 m/s); when it happens is taken from the mean, and the error of that is carried through it.
/// Drag is that of a ball in air (kicking::Air) +- 50 %.
class FlightFilter {
 public:
  /// How a ball goes: through the air, or on the floor, where it stays. One that was kicked low slides at first, with
  /// low bounces, and is slowed by 2.5 +- 2.5 m/s^2 in place of 0.5 +- 0.3.
  enum class Way { kFlies, kRolls, kSlides };

  /// A ball seen at `first` that has `velocity_mps` with the standard deviations `sd_mps`.
  FlightFilter(const kicking::Sighting& first, double ball_sd_m, const Eigen::Vector3d& velocity_mps,
               const Eigen::Vector3d& sd_mps, Way way);

  void advance(double dt_s);

  /// Corrects by a sighting. Returns the squared innovations by their variances, of x, y and z.
  std::array<double, 3> correct(const Eigen::Vector3d& ball_m, double ball_sd_m);
  /// ln det of the innovations' variances of the last correction, x and y.
  double log_variance() const { return log_variance_; }

  /// Something turned the ball by N(mean, sd^2) along x and y, at an instant evenly within the last `dt_s`.
  void turn(const Eigen::Vector2d& mean_mps, double sd_mps, double dt_s);
  /// The plane at y_m throws the ball back: it keeps `ratio` +- sd of its speed.
  void throw_back(double y_m, double ratio, double sd);

  const AxisState& x() const { return x_; }
  const AxisState& y() const { return y_; }
  const AxisState& z() const { return z_; }
  bool bounced() const { return bounced_; }
  double speed_mps() const;  ///< over ground

 private:
  void fly(double dt_s);
  void roll(double dt_s);
  void bounce();

  AxisState x_, y_, z_;
  double log_variance_ = 0.0;
  bool rolling_ = false;
  bool slides_ = false;
  bool bounced_ = false;
};

}  // namespace trivela::robot
