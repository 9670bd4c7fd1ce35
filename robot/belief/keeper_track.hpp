#pragma once

#include <cstdint>
#include <optional>

#include "kicking/outcome/keeper.hpp"

namespace trivela::robot {

/// Where the opponents' keeper stands along its goal line: a Kalman filter of one state, which between pictures goes
/// back to what is known of any keeper, N(0, s^2) about the goal's middle. With q = exp(-t / T), s = 0.3 m, T = 5 s:
///
///     x' = q x,   var' = q^2 var + (1 - q^2) s^2
class KeeperTrack {
 public:
  /// A picture of t_ns shows it at x_m in F, an error of seen_sd_m; one that is not newer than the last counts for
  /// nothing, nor one that shows it where no keeper stands.
  void observe(std::int64_t t_ns, double x_m, double seen_sd_m);

  /// As known at t_ns; none: it was never seen.
  std::optional<kicking::KeeperPlace> at(std::int64_t t_ns) const;

 private:
  std::int64_t t_ns_ = 0;
  double x_m_ = 0.0;
  double var_m2_ = 0.0;  // 0: never seen
};

}  // namespace trivela::robot
