#include "kicking/outcome/outcome.hpp"

#include <cassert>
#include <cmath>

namespace trivela::kicking {

const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOnTarget:
      return "on_target";
    case Outcome::kWideLeft:
      return "wide_left";
    case Outcome::kWideRight:
      return "wide_right";
    case Outcome::kOver:
      return "over";
    case Outcome::kShort:
      return "short";
    case Outcome::kPost:
      return "post";
    case Outcome::kBar:
      return "bar";
    case Outcome::kBlocked:
      return "blocked";
    case Outcome::kUnknown:
      return "unknown";
  }
  assert(false);
  return "unknown";
}

Outcome classify(double x_cross_m, double z_cross_m, const Goal& goal, const Ball& ball) {
  if (!std::isfinite(x_cross_m) || !std::isfinite(z_cross_m)) return Outcome::kUnknown;
  const double side = std::abs(x_cross_m);
  if (side >= goal.wide_half_width_m(ball)) return x_cross_m < 0.0 ? Outcome::kWideLeft : Outcome::kWideRight;
  if (z_cross_m >= goal.over_height_m(ball)) return Outcome::kOver;
  if (side >= goal.clean_half_width_m(ball)) return Outcome::kPost;
  if (z_cross_m >= goal.clean_height_m(ball)) return Outcome::kBar;
  return Outcome::kOnTarget;
}

}  // namespace trivela::kicking
