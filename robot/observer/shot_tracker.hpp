#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "kicking/ballistics/flight.hpp"
#include "kicking/optional_double.hpp"
#include "robot/observer/shot_judge.hpp"

namespace trivela::robot {

/// How far a sighting lies from the ball, learned from the flights seen so far.
///
/// Each sighting is held against the straight line between its two neighbours in time, sideways and forward: with the
/// share w of the way between them it is off by sd sqrt(1 + (1 - w)^2 + w^2), whatever the ball's way, as long as that
/// is nearly straight. The median of what they are off makes a kink or two harmless. The configured value counts as
/// four sightings, what was learned as a hundred at most, so that a camera may change.
class CameraNoise {
 public:
  explicit CameraNoise(double configured_sd_m);

  /// Learns from one flight.
  void learn(std::span<const kicking::Sighting> sightings);

  double sd_m() const;
  /// Sightings that the value rests on.
  double weight() const { return weight_; }

 private:
  double configured_m2_;
  double learned_m2_ = 0.0;  // sum of squares
  double weight_ = 0.0;
};

/// How often a ball between posts and bar is saved, learned from the shots seen so far. With S the sum of p_saved and N
/// that of p_on_target, and a mean of 0.005 before anything is seen, worth two shots:
///
///     ratio = (0.01 + S) / (2 + N)
class SaveWatch {
 public:
  void learn(const ShotVerdict& verdict) {
    if (!verdict.p_saved || !verdict.probabilities) return;
    saved_ += *verdict.p_saved;
    on_target_ += (*verdict.probabilities)[static_cast<std::size_t>(kicking::Outcome::kOnTarget)];
  }
  double ratio() const { return (kShots * ShotTrack{}.save_ratio + saved_) / (kShots + on_target_); }

 private:
  static constexpr double kShots = 2.0;
  double saved_ = 0.0;
  double on_target_ = 0.0;
};

/// A kick whose flight is over.
struct TrackedShot {
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;  ///< exposure that settled it
  std::size_t sightings = 0;
  ShotVerdict verdict;
};

/// Follows the ball after each release until the shot is settled. It sees the flight camera's frames and the receipts
/// and nothing else. A receipt may come later than the first frames of its flight: the last `history_s` of frames are
/// kept. How far a sighting may be off it learns from flight to flight.
class ShotTracker {
 public:
  ShotTracker(const config::ShotObserver& settings, const kicking::Goal& goal)
      : settings_(settings), goal_(goal), noise_(settings.ball_sd_m) {}

  /// A kick was accepted and leaves at `release_t_ns` with `expected_speed_mps` over ground and `expected_climb_mps`
  /// upwards (none: not known). A shot still open is judged by what was seen of it.
  std::vector<TrackedShot> release(std::int64_t kick_id, std::int64_t release_t_ns, double expected_speed_mps,
                                   kicking::OptionalDouble expected_climb_mps = std::nullopt);

  /// One frame; nullopt where the ball was not seen.
  std::vector<TrackedShot> frame(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball_m);

  /// A shot is open: frames and the referee's word count for it.
  bool follows() const { return open_.has_value(); }

  /// The referee stopped the game at `t_ns`: what was seen until then settles an open shot.
  std::vector<TrackedShot> stopped(std::int64_t t_ns);

 private:
  struct Open {
    std::int64_t kick_id;
    std::int64_t release_t_ns;
    double expected_speed_mps;
    kicking::OptionalDouble expected_climb_mps;
    std::int64_t seen_t_ns;
    double farthest_y_m;
    std::vector<kicking::Sighting> sightings;
  };

  std::optional<FlightEnd> follow(const kicking::Sighting& sighting);
  std::optional<FlightEnd> missed(std::int64_t t_ns) const;
  std::optional<FlightEnd> step(std::int64_t t_ns, const std::optional<Eigen::Vector3d>& ball_m);
  bool at_rest() const;
  bool beyond_line(double y_m) const;
  bool came_back(double y_m) const;
  FlightEnd where_it_was() const;
  TrackedShot settle(FlightEnd end, std::int64_t t_ns);

  config::ShotObserver settings_;
  kicking::Goal goal_;
  CameraNoise noise_;
  SaveWatch saves_;
  std::deque<kicking::Sighting> history_;
  std::optional<Open> open_;
};

}  // namespace trivela::robot
