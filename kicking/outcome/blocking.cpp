#include "kicking/outcome/blocking.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/outcome/p_inside.hpp"

namespace trivela::kicking {

double p_in_the_way(const Eigen::Vector2d& relative_m, double sd_m, const KickPath& path, const Body& body,
                    const Ball& ball, double gravity_mps2) {
  const double speed_mps = path.velocity_mps.norm(), reach_m = body.radius_m + ball.radius_m;
  if (!(speed_mps > 0.0)) return 0.0;
  const Eigen::Vector2d along = path.velocity_mps / speed_mps;
  const double s_m = relative_m.dot(along), u_m = relative_m.x() * along.y() - relative_m.y() * along.x();
  if (s_m <= 0.0) return 0.0;
  const auto clears = [&](double way_m) {
    const double t = std::max(0.0, way_m) / speed_mps;
    return path.v_z_mps * t - 0.5 * gravity_mps2 * t * t >= body.height_m;
  };
  if (clears(s_m - reach_m) && clears(s_m + reach_m)) return 0.0;
  const double sd_u_m = std::hypot(sd_m, s_m * path.sd_rad);
  return normal_below(reach_m - u_m, sd_u_m) - normal_below(-reach_m - u_m, sd_u_m);
}

}  // namespace trivela::kicking
