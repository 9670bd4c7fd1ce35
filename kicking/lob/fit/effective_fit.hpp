#pragma once

#include <optional>
#include <span>

#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// The parabola z = a + b x - c x^2 through the centres, least squares in z, and what the paper makes of it (section
/// 2.2): with s = b^2 + 4 c (a - z_0), z_0 the launch height,
///   H = s / (4 c),  D = sqrt(s) / c,  theta = atan(4 H / D) = atan(sqrt(s)),  V0 = sqrt(D g / sin 2 theta)
///                                                                            = sqrt(g (1 + s) / (2 c)).
/// Standard errors by propagating the covariance of (a, b, c). Effective values: drag is absorbed; times are not used.
struct Parabola {
  double apex_x_m = 0.0;
  double launch_x_m = 0.0;  ///< where it rises through z_0, going with the ball
  EffectiveFit values;
};

/// Returns none for fewer than 4 centres or a curve that is no arch over z_0.
std::optional<Parabola> fit_parabola(std::span<const BallCentre> centres, double launch_z_m);

}  // namespace trivela::kicking::lob
