#include "robot/belief/opponent_tracks.hpp"

#include <algorithm>
#include <array>
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

namespace {

constexpr double kWalk_mps = 2.0;      // in a second; assumption
constexpr double kAnySpeed_mps = 1.5;  // standard deviation of a velocity before it was watched, each axis; assumption
constexpr double kMostOff_sd = 4.0;
constexpr double kDropped_s = 1.0;

void correct(OpponentTrack& track, const Eigen::Vector2d& seen_m, double var_seen_m2) {
  const double variance = track.var_m2 + var_seen_m2;
  const double gain = track.var_m2 / variance, gain_v = track.cov_m2ps / variance;
  const Eigen::Vector2d innovation_m = seen_m - track.position_m;
  track.position_m += gain * innovation_m;
  track.velocity_mps += gain_v * innovation_m;
  track.var_m2ps2 -= gain_v * track.cov_m2ps;
  track.cov_m2ps *= 1.0 - gain;
  track.var_m2 *= 1.0 - gain;
}

}  // namespace

OpponentTrack OpponentTrack::at(std::int64_t t) const {
  OpponentTrack then = *this;
  const double dt_s = std::clamp(kicking::seconds(t - t_ns), 0.0, 2.0);
  then.t_ns = std::max(t, t_ns);
  then.position_m += dt_s * velocity_mps;
  then.var_m2 += dt_s * (2.0 * cov_m2ps + dt_s * var_m2ps2);
  then.cov_m2ps += dt_s * var_m2ps2;
  then.var_m2ps2 += kWalk_mps * kWalk_mps * dt_s;
  return then;
}

void OpponentTracks::observe(std::int64_t t_ns, std::span<const Eigen::Vector2d> seen_m, double seen_sd_m) {
  if (!(seen_sd_m > 0.0)) return;
  for (OpponentTrack& track : tracks_) track = track.at(t_ns);
  std::array<bool, kicking::kMostBodies> taken{};
  const double var_seen_m2 = seen_sd_m * seen_sd_m;
  for (const Eigen::Vector2d& seen : seen_m) {
    if (!seen.allFinite()) continue;
    std::size_t best = tracks_.size();
    double best_sd = kMostOff_sd;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const double off_sd = (seen - tracks_[i].position_m).norm() / std::sqrt(tracks_[i].var_m2 + var_seen_m2);
      if (taken[i] || off_sd >= best_sd) continue;
      best = i;
      best_sd = off_sd;
    }
    if (best == tracks_.size()) {
      if (best == kicking::kMostBodies) continue;
      tracks_.push_back({t_ns, t_ns, seen, {0.0, 0.0}, var_seen_m2, 0.0, kAnySpeed_mps * kAnySpeed_mps});
    } else {
      correct(tracks_[best], seen, var_seen_m2);
      tracks_[best].seen_t_ns = t_ns;
    }
    taken[best] = true;
  }
  std::erase_if(tracks_,
                [=](const OpponentTrack& track) { return kicking::seconds(t_ns - track.seen_t_ns) > kDropped_s; });
}

}  // namespace trivela::robot
