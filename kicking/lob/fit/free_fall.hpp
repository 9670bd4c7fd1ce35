#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// x and z at an instant.
struct FallingPoint {
  double x_m = 0.0;
  double z_m = 0.0;
};

/// Where a ball in free fall is at t_ns: x = x_1 + v_x t, z = z_1 + v_z t - g t^2 / 2, least squares through the
/// centres (two at least) of the last 0.4 s. Over that time drag bends the path by a centimetre, and a ball that rolls
/// leaves it by more than ten.
FallingPoint predict_fall(std::span<const BallCentre> centres, std::int64_t t_ns);

/// The third of three centres lies where the free fall through the first two leads, at 2 to 20 m/s: within 6 cm and
/// what 2 m/s2 more or less make.
bool may_start_flight(const BallCentre& first, const BallCentre& second, const BallCentre& third);

/// z(t) as a parabola of its own.
struct VerticalMotion {
  Estimate acceleration_mps2;
  double off_m = 0.0;  ///< median distance of the centres from it, vertically
};

/// Least squares; none below 4 centres.
std::optional<VerticalMotion> vertical_motion(std::span<const BallCentre> centres);

/// The centres accelerate downwards like a ball in the air: within 35 % of g, or within 2.5 standard errors where those
/// are larger, but never beyond 70 %; half of them within 2 cm, after t seconds 2 cm (1 + t^3), of
/// their own parabola.
bool falls_freely(std::span<const BallCentre> centres);

}  // namespace trivela::kicking::lob
