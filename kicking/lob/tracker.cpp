#include "kicking/lob/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/lob/fit/free_fall.hpp"

namespace trivela::kicking::lob {
namespace {

constexpr int kLeastCentres = 6;  // that show an acceleration, or a ball that lies

double apart_m(const BallCentre& a, double x_m, double z_m) { return std::hypot(a.x_m - x_m, a.z_m - z_m); }

}  // namespace

Tracker::Tracker(const AnalyzerConfig& config, double scan_period_s)
    : config_(config), lost_s_(std::max(config.lost_s, 2.5 * scan_period_s)) {
  for (Track& track : tracks_) track.centres.reserve(128);
}

std::optional<Flight> Tracker::add(std::int64_t t_ns, std::span<const BallCentre> candidates) {
  used_.assign(candidates.size(), 0);
  std::optional<Flight> ended;
  for (Track& track : tracks_) {
    track.taken.reset();
    if (track.centres.empty()) continue;
    if (is_over(track, t_ns)) {
      auto flight = end(track);
      if (flight && (!ended || flight->centres.size() > ended->centres.size())) ended = std::move(flight);
    } else {
      extend(track, candidates);
    }
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!used_[i]) look_for_rest(candidates[i]);
    for (const BallCentre& second : unused_[1]) {
      for (const BallCentre& first : unused_[0]) {
        if (!used_[i] && may_start_flight(first, second, candidates[i])) start(first, second, i, candidates);
      }
    }
  }
  remember_unused(candidates);
  return ended;
}

void Tracker::remember_unused(std::span<const BallCentre> candidates) {
  constexpr std::size_t kMost = 12;  // what looks most like a ball; a crowd must not cost the next scan
  std::swap(unused_[0], unused_[1]);
  auto& unused = unused_[1];
  unused.clear();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!used_[i]) unused.push_back(candidates[i]);
  }
  if (unused.size() <= kMost) return;
  std::nth_element(unused.begin(), unused.begin() + kMost, unused.end(), [](const auto& a, const auto& b) {
    return std::abs(a.chord_ratio - 1.0) < std::abs(b.chord_ratio - 1.0);
  });
  unused.resize(kMost);
}

void Tracker::extend(Track& track, std::span<const BallCentre> candidates) {
  double nearest_m = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (used_[i]) continue;
    const FallingPoint expected = predict_fall(track.centres, candidates[i].t_ns);
    const double gap_s = seconds(track.centres.back().t_ns, candidates[i].t_ns);
    const double off_m = apart_m(candidates[i], expected.x_m, expected.z_m);
    if (off_m > 0.10 + gap_s * gap_s || (track.taken && off_m >= nearest_m)) continue;
    nearest_m = off_m;
    track.taken = i;
  }
  if (!track.taken) return;
  used_[*track.taken] = 1;
  track.centres.push_back(candidates[*track.taken]);
}

void Tracker::start(const BallCentre& first, const BallCentre& second, std::size_t third,
                    std::span<const BallCentre> candidates) {
  constexpr double kAfterLanding_s = 0.5, kFromLanding_m = 1.0, kRetained_mps = 6.0;
  constexpr double kAfterRest_s = 0.5, kFromRest_m = 0.5;
  const auto track = std::find_if(tracks_.begin(), tracks_.end(), [](const Track& t) { return t.centres.empty(); });
  if (track == tracks_.end()) return;
  track->centres = {first, second, candidates[third]};
  track->taken = third;
  const double since_s = landed_ ? seconds(landed_->t_ns, first.t_ns) : kAfterLanding_s;
  track->bounced = std::abs(since_s) < kAfterLanding_s &&
                   apart_m(*landed_, first.x_m, first.z_m) < kFromLanding_m + kRetained_mps * since_s;
  const bool lay = rest_.seen >= kLeastCentres && seconds(rest_.t_ns, first.t_ns) < kAfterRest_s &&
                   apart_m(first, rest_.x_m, rest_.z_m) < kFromRest_m;
  track->launch_z_m = lay ? rest_.z_m : config_.ball.radius_m;
  used_[third] = 1;
}

bool Tracker::is_over(const Track& track, std::int64_t t_ns) const {
  constexpr double kIntoFloor_m = 0.12;
  return seconds(track.centres.back().t_ns, t_ns) > lost_s_ ||
         predict_fall(track.centres, t_ns).z_m < config_.ball.radius_m - kIntoFloor_m;
}

bool Tracker::is_flight(const Track& track) const {
  return std::ssize(track.centres) >= kLeastCentres && falls_freely(track.centres);
}

std::optional<Flight> Tracker::end(Track& track) {
  std::optional<Flight> flight;
  if (is_flight(track)) {
    landed_ = track.centres.back();
    if (!track.bounced) flight = Flight{track.centres, track.launch_z_m};
  }
  track.centres.clear();
  track.taken.reset();
  return flight;
}

std::optional<Flight> Tracker::finish() {
  std::optional<Flight> longest;
  for (Track& track : tracks_) {
    auto flight = end(track);
    if (flight && (!longest || flight->centres.size() > longest->centres.size())) longest = std::move(flight);
  }
  return longest;
}

void Tracker::look_for_rest(const BallCentre& candidate) {
  constexpr double kStill_m = 0.03, kNearFloor_m = 0.1, kForgotten_s = 1.0;
  constexpr int kMemory = 40;
  if (rest_.seen > 0 && apart_m(candidate, rest_.x_m, rest_.z_m) < kStill_m) {
    rest_.seen = std::min(rest_.seen + 1, kMemory);
    rest_.x_m += (candidate.x_m - rest_.x_m) / rest_.seen;
    rest_.z_m += (candidate.z_m - rest_.z_m) / rest_.seen;
    rest_.t_ns = candidate.t_ns;
  } else if (std::abs(candidate.z_m - config_.ball.radius_m) < kNearFloor_m &&
             (rest_.seen < kLeastCentres || seconds(rest_.t_ns, candidate.t_ns) > kForgotten_s)) {
    rest_ = {candidate.x_m, candidate.z_m, 1, candidate.t_ns};
  }
}

const std::vector<BallCentre>* Tracker::under_way() const {
  const Track* longest = nullptr;
  for (const Track& track : tracks_) {
    if (!track.bounced && is_flight(track) && (!longest || track.centres.size() > longest->centres.size()))
      longest = &track;
  }
  return longest ? &longest->centres : nullptr;
}

std::optional<std::size_t> Tracker::ball() const {
  const auto* const centres = under_way();
  for (const Track& track : tracks_) {
    if (&track.centres == centres) return track.taken;
  }
  return std::nullopt;
}

}  // namespace trivela::kicking::lob
