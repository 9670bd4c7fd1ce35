#include "robot/observer/shot_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/estimate.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double kConfiguredWeight = 4.0;
constexpr double kMostWeight = 100.0;
constexpr double kWeightOfATriplet = 0.5;  // a median of two overlapping differences knows about half of it
constexpr double kMedianOfNormal = 0.6744897501960817;

}  // namespace

CameraNoise::CameraNoise(double configured_sd_m) : configured_m2_(configured_sd_m * configured_sd_m) {}

void CameraNoise::learn(std::span<const kicking::Sighting> sightings) {
  if (sightings.size() < 3) return;
  std::vector<double> off_m;
  off_m.reserve(2 * (sightings.size() - 2));
  for (std::size_t i = 1; i + 1 < sightings.size(); ++i) {
    const kicking::Sighting &a = sightings[i - 1], &b = sightings[i], &c = sightings[i + 1];
    if (a.t_ns >= c.t_ns) continue;
    const double w = static_cast<double>(b.t_ns - a.t_ns) / static_cast<double>(c.t_ns - a.t_ns);
    const double scale = 1.0 / std::sqrt(1.0 + (1.0 - w) * (1.0 - w) + w * w);
    for (const int axis : {0, 1})
      off_m.push_back(scale * std::abs(b.ball_m[axis] - (1.0 - w) * a.ball_m[axis] - w * c.ball_m[axis]));
  }
  if (off_m.empty()) return;
  const double sd_m = kicking::upper_median(std::span(off_m)) / kMedianOfNormal;
  const double weight = kWeightOfATriplet * 0.5 * static_cast<double>(off_m.size());
  learned_m2_ += weight * sd_m * sd_m;
  weight_ += weight;
  if (weight_ > kMostWeight) {
    learned_m2_ *= kMostWeight / weight_;
    weight_ = kMostWeight;
  }
}

double CameraNoise::sd_m() const {
  return std::sqrt((kConfiguredWeight * configured_m2_ + learned_m2_) / (kConfiguredWeight + weight_));
}

namespace {

constexpr std::size_t kUsualSightings = 256;
constexpr double kJump_m = 1.0;        // between sightings: the ball was taken away ...
constexpr double kFastest_mps = 15.0;  // ... unless they are so far apart that it flew
constexpr double kFrameDepth_m = 0.4;  // a turn this close to the plane is the goal frame's work
constexpr double kCameBack_m = 0.25;   // farther from its farthest point than the frame rate explains ...
constexpr double kCameBack_sd = 8.0;   // ... and than noise does
constexpr double kBeyond_sd = 4.0;     // sightings beyond the line by this many standard deviations are believed

}  // namespace

std::vector<TrackedShot> ShotTracker::release(std::int64_t kick_id, std::int64_t release_t_ns,
                                              double expected_speed_mps, kicking::OptionalDouble expected_climb_mps) {
  std::vector<TrackedShot> settled;
  if (open_) settled.push_back(settle(FlightEnd::kLost, release_t_ns));
  open_ = Open{kick_id, release_t_ns, expected_speed_mps, expected_climb_mps, release_t_ns, -HUGE_VAL, {}};
  open_->sightings.reserve(kUsualSightings);
  for (const kicking::Sighting& sighting : history_) {
    if (!open_) break;
    if (sighting.t_ns < release_t_ns) continue;
    if (const auto end = step(sighting.t_ns, sighting.ball_m)) settled.push_back(settle(*end, sighting.t_ns));
  }
  return settled;
}

std::vector<TrackedShot> ShotTracker::frame(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball_m) {
  const bool seen = ball_m && ball_m->allFinite();
  if (seen) history_.push_back({t_ns, *ball_m});
  while (!history_.empty() && kicking::seconds(t_ns - history_.front().t_ns) > settings_.history_s)
    history_.pop_front();
  if (!open_ || t_ns < open_->release_t_ns) return {};
  if (const auto end = step(t_ns, seen ? ball_m : std::nullopt)) return {settle(*end, t_ns)};
  return {};
}

std::optional<FlightEnd> ShotTracker::step(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball_m) {
  return ball_m ? follow({t_ns, *ball_m}) : missed(t_ns);
}

std::optional<FlightEnd> ShotTracker::missed(std::int64_t t_ns) const {
  if (kicking::seconds(t_ns - open_->seen_t_ns) <= settings_.lost_s) return std::nullopt;
  const bool beyond = !open_->sightings.empty() && beyond_line(open_->sightings.back().ball_m.y());
  return beyond ? FlightEnd::kBeyondLine : FlightEnd::kLost;
}

std::vector<TrackedShot> ShotTracker::stopped(std::int64_t t_ns) {
  if (!open_ || t_ns < open_->release_t_ns) return {};
  return {settle(where_it_was(), t_ns)};
}

bool ShotTracker::beyond_line(double y_m) const { return y_m > goal_.y_m + kBeyond_sd * noise_.sd_m(); }

bool ShotTracker::came_back(double y_m) const {
  const double by_m = std::max(kCameBack_m, kCameBack_sd * noise_.sd_m());
  return open_->farthest_y_m - y_m > by_m && open_->farthest_y_m > goal_.y_m - kFrameDepth_m;
}

/// How a flight ended that is over from one frame to the next.
FlightEnd ShotTracker::where_it_was() const {
  if (open_->sightings.empty()) return FlightEnd::kLost;
  return beyond_line(open_->sightings.back().ball_m.y()) ? FlightEnd::kBeyondLine : FlightEnd::kTakenAway;
}

std::optional<FlightEnd> ShotTracker::follow(const kicking::Sighting& sighting) {
  auto& sightings = open_->sightings;
  if (!sightings.empty()) {
    const double apart_s = kicking::seconds(sighting.t_ns - sightings.back().t_ns);
    const double far_m = std::max(kJump_m, kFastest_mps * apart_s) + kBeyond_sd * noise_.sd_m();
    if ((sighting.ball_m - sightings.back().ball_m).norm() > far_m) return where_it_was();
  }
  sightings.push_back(sighting);
  open_->seen_t_ns = sighting.t_ns;
  open_->farthest_y_m = std::max(open_->farthest_y_m, sighting.ball_m.y());
  const double y_m = sighting.ball_m.y();
  if (beyond_line(y_m)) return FlightEnd::kBeyondLine;
  if (came_back(y_m)) return FlightEnd::kThrownBack;
  if (at_rest() || kicking::seconds(sighting.t_ns - open_->release_t_ns) > settings_.time_out_s) {
    return FlightEnd::kAtRest;
  }
  return std::nullopt;
}

/// Slower than rest_speed over the last half second.
bool ShotTracker::at_rest() const {
  const auto& sightings = open_->sightings;
  const auto from = std::find_if(sightings.begin(), sightings.end(), [&](const kicking::Sighting& s) {
    return kicking::seconds(sightings.back().t_ns - s.t_ns) <= 0.5;
  });
  const double span_s = kicking::seconds(sightings.back().t_ns - from->t_ns);
  if (from == sightings.begin() || span_s < 0.25) return false;
  return (sightings.back().ball_m - from->ball_m).norm() < settings_.rest_speed_mps * span_s;
}

TrackedShot ShotTracker::settle(FlightEnd end, std::int64_t t_ns) {
  const Open shot = std::move(*open_);
  open_.reset();
  noise_.learn(shot.sightings);
  const ShotTrack track{.sightings = shot.sightings,
                        .end = end,
                        .release_t_ns = shot.release_t_ns,
                        .end_t_ns = t_ns,
                        .expected_speed_mps = shot.expected_speed_mps,
                        .expected_climb_mps = shot.expected_climb_mps,
                        .ball_sd_m = noise_.sd_m(),
                        .save_ratio = saves_.ratio()};
  const ShotVerdict verdict = judge_shot(track, goal_, settings_);
  saves_.learn(verdict);
  return {shot.kick_id, t_ns, shot.sightings.size(), verdict};
}

}  // namespace trivela::robot
