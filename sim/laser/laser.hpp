#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "kicking/lob/scan.hpp"
#include "kicking/random/draws.hpp"
#include "sim/scenario.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// A scanning range finder beside the field whose scan plane stands upright. "Assumption": no publication gives it. No
/// public laser scan of a flying ball exists; the error model is put together from measurements of standing targets.
struct LaserModel {
  kicking::lob::ScanGeometry geometry{};  ///< UTM-30LX: SCIP 2.0 specification
  double x_m = 4.0;                       ///< in F
  double y_m = 0.0;                       ///< in F
  double z_m = 0.05;                      ///< over the floor; assumption: it lies on its side
  /// Horizontal direction in the scan plane that elevations are counted from, the kick's if all is well: a heading in
  /// F, 0 faces +y, counter-clockwise. Its unit vector is u = (-sin, cos); -90 degrees: u = +x.
  double heading_rad = -1.5707963267948966;
  double front_elevation_rad = 1.5707963267948966;  ///< as in LaserMount
  bool mirrored = false;                            ///< as in LaserMount
  double range_sd_m = 0.010;                        ///< white; UTM-30LX and URG-04LX: 4 to 16 mm measured at 1 to 4 m
  double dropout_ratio = 0.005;                     ///< beams without an answer; UTM-30LX recording: 0.7 % invalid
  double mixed_ratio = 0.3;    ///< a beam that just misses the ball reads something behind its edge; assumption
  double mixed_depth_m = 0.5;  ///< ... up to so much, or up to the background if that is nearer; assumption
  std::optional<double> wall_ahead_m = 12.0;  ///< upright wall along +u from the scanner; assumption
  std::optional<double> wall_behind_m;        ///< along -u
  std::optional<double> ceiling_m;            ///< over the floor
};

/// The pose as the analyzer has to know it, for kicks from `launch`: x along u from there.
inline kicking::lob::LaserMount mount_of(const LaserModel& laser, const Eigen::Vector3d& launch) {
  const double along_m =
      (laser.x_m - launch.x()) * -std::sin(laser.heading_rad) + (laser.y_m - launch.y()) * std::cos(laser.heading_rad);
  return {along_m, laser.z_m, laser.front_elevation_rad, laser.mirrored};
}

/// What a range finder measures while the world goes on. Beam i of scan j is measured at t_j + i beam_period:
///   in the scan plane  ball centre (X, Z) from the scanner, e off the plane, rho = sqrt(r^2 - e^2)
///   beam of elevation a  along = X cos a + Z sin a,  q = X sin a - Z cos a
///   range  along - sqrt(rho^2 - q^2) if |q| < rho and along > 0, else floor, wall or ceiling; + N(0, range_sd)
/// beside dropouts and mixed pixels. Answers beyond the scanner's limits are the error code 1. The random numbers are
/// fixed by (seed, opportunity, scan, beam): however often the world is stepped, the noise is the same.
class ScanBuilder {
 public:
  /// The first scan starts at `first_t_ns`. Throws std::invalid_argument for a geometry without beams or with a beam or
  /// scan period that is not positive.
  ScanBuilder(const LaserModel& laser, double ball_radius_m, const kicking::Draws& draws, std::int64_t first_t_ns = 0);

  /// The ball's centre in F at t_ns, none if there is no ball. Call after each physics step, a millisecond at most: the
  /// beams since the last call are measured, the ball being on the straight line between the two places. Time goes
  /// forward only; std::invalid_argument otherwise.
  void advance(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball);

  /// The oldest scan whose last beam has been measured and that was not taken yet.
  std::optional<kicking::lob::Scan> take();

  /// The random numbers of another opportunity, from the next beam on.
  void use(const kicking::Draws& draws) { draws_ = draws; }

 private:
  /// Direction of a beam in the scan plane, and what it reads without a ball.
  struct Beam {
    double cos_a;
    double sin_a;
    double background_m;  ///< infinite: nothing there
  };

  /// Ball centre from the scanner: x along u, z up, y to the left of the scan plane.
  Eigen::Vector3d in_plane(const Eigen::Vector3d& ball) const;
  /// Range of the ball in the beam; none: the beam misses it.
  std::optional<double> ball_range(const Beam& beam, const Eigen::Vector3d& ball) const;
  void measure(std::size_t i, const std::optional<Eigen::Vector3d>& ball);
  std::uint32_t answer(std::size_t i, double range_m) const;
  /// The beam beside the ball's edge, maybe a mixed pixel.
  void mix(std::size_t i, double edge_m);
  std::int64_t beam_t_ns(std::size_t i) const;

  LaserModel laser_;
  double radius_m_;
  kicking::Draws draws_;
  std::vector<Beam> beams_;
  std::deque<kicking::lob::Scan> complete_;
  std::int64_t first_t_ns_;
  kicking::lob::Scan scan_;  ///< under way
  std::uint32_t scan_index_ = 0;
  std::size_t next_beam_ = 0;
  std::optional<double> edge_m_;  ///< range of the ball in the beam before
  std::int64_t t_ns_;
  std::optional<Eigen::Vector3d> ball_;  ///< at t_ns_, in_plane()
};

/// The range finder of a scenario: a UTM-30LX.
LaserModel laser_model(const Laser& laser);

/// The laser of a match: nothing without one.
class FieldLaser {
 public:
  /// The first scan starts at t_ns 0.
  FieldLaser(const Laser& laser, double ball_radius_m);

  /// Another opportunity begins: its random numbers, and the ball is somewhere else from one instant to the next.
  void begin(const kicking::Draws& draws);

  /// The ball's centre at t_ns, after each sub-step.
  void see(std::int64_t t_ns, const Eigen::Vector3d& ball_m);

  /// Scans finished since forget().
  const std::vector<kicking::lob::Scan>& scans() const { return scans_; }
  void forget() { scans_.clear(); }

 private:
  std::optional<ScanBuilder> builder_;
  bool ball_was_moved_ = true;
  std::vector<kicking::lob::Scan> scans_;
};

}  // namespace trivela::sim
