#include "robot/belief/keeper_track.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double kAnywhere_m = 0.3, kForgets_s = 5.0;  // assumptions
// A picture that shows it farther off is of another robot, or taken by one that does not know its own place.
constexpr double kNotIt_sd = 5.0;

}  // namespace

std::optional<kicking::KeeperPlace> KeeperTrack::at(std::int64_t t_ns) const {
  if (!(var_m2_ > 0.0)) return std::nullopt;
  const double kept = std::exp(-std::max(0.0, kicking::seconds(t_ns - t_ns_)) / kForgets_s);
  const double var_m2 = kept * kept * var_m2_ + (1.0 - kept * kept) * kAnywhere_m * kAnywhere_m;
  return kicking::KeeperPlace{kept * x_m_, std::sqrt(var_m2)};
}

void KeeperTrack::observe(std::int64_t t_ns, double x_m, double seen_sd_m) {
  if (!std::isfinite(x_m) || !(seen_sd_m > 0.0) || (var_m2_ > 0.0 && t_ns <= t_ns_)) return;
  const kicking::KeeperPlace before = at(t_ns).value_or(kicking::KeeperPlace{0.0, kAnywhere_m});
  if (std::abs(x_m - before.x_m) > kNotIt_sd * std::hypot(kAnywhere_m, seen_sd_m)) return;
  const double before_m2 = before.sd_m * before.sd_m, gain = before_m2 / (before_m2 + seen_sd_m * seen_sd_m);
  x_m_ = before.x_m + gain * (x_m - before.x_m);
  var_m2_ = (1.0 - gain) * before_m2;
  t_ns_ = t_ns;
}

}  // namespace trivela::robot
