#pragma once

#include <optional>
#include <span>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/cluster.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// A centre from the scanner [m].
struct PlanePoint {
  double x = 0.0;
  double z = 0.0;
};

/// The paper's estimate (section 2.1, Figure 3): the middle M of the two outer returns, moved away from the scanner by
/// one ball radius: M + r M / |M|. Literally taken it lies too far by up to r - r^2 / D, D being the distance: 7 cm at
/// 4 m with a quarter of a degree.
PlanePoint middle_of_limits(std::span<const BeamReturn> cluster, double radius_m);

/// A circle of the ball's radius, and the sum of squared range errors that it leaves.
struct CircleFit {
  PlanePoint centre;
  double cost_m2 = 0.0;
};

/// The circle of the ball's radius, least squares in range: minimises sum (range_i - m_i)^2 over the centre at D in
/// direction u, among the centres whose ball crosses every beam of the cluster, |d_i| < asin(r / D):
///   m_i = D cos d_i - sqrt(r^2 - D^2 sin^2 d_i),  d_i the angle of beam i from u.
/// By golden section over the direction (what is feasible is a step of the beams wide), Gauss-Newton in D.
CircleFit circle_of_known_radius(std::span<const BeamReturn> cluster, double radius_m);

/// The cluster without a return at either end, or both, if the squared error falls by more than (3 cm)^2 for each:
/// mixed pixels, half on the ball and half on what is behind. `fit`, that of the whole cluster, becomes that of what is
/// left.
std::span<const BeamReturn> without_mixed_pixels(std::span<const BeamReturn> cluster, CircleFit& fit, double radius_m);

/// The ball's centre if the cluster may be a ball: the angle that it covers is that of a ball there,
///   |(beams) step / (2 asin(r / D)) - 1| <= chord_tolerance.
/// x and z are from the scanner; the time is that of the beam through the centre.
std::optional<BallCentre> find_ball(std::span<const BeamReturn> cluster, double step_rad, const AnalyzerConfig& config);

}  // namespace trivela::kicking::lob
