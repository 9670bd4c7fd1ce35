#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kicking/outcome/outcome.hpp"
#include "sim/flight.hpp"
#include "sim/opponent_body.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// What a shot came to.
struct ShotResult {
  std::int64_t t_ns = 0;
  kicking::Outcome outcome{};
  std::optional<Crossing> crossing;
  std::optional<double> margin_m;
  bool saved = false;  ///< on target, but the keeper had it
};

/// A released ball on its way to the goal. The goal frame is flat, in the plane of the goal line: what counts is where
/// the centre passes it. Post and bar throw the ball back, an opponent's body (a cylinder) turns it away; the first
/// thing met decides. A keeper stands in the middle of the goal line; `reaction_s` after the release it moves to where
/// the ball will cross, and has what comes within its width and height.
class Shot {
 public:
  /// `scenario` must outlive the shot.
  Shot(const Scenario& scenario, const BallMotion& released, std::int64_t t_ns);

  /// Moves the ball to t_ns, a control cycle ahead at most, while the opponents stand.
  void advance_to(std::int64_t t_ns, std::span<const OpponentBody> opponents);

  const BallMotion& ball() const { return ball_; }
  std::int64_t release_t_ns() const { return release_t_ns_; }
  const BallMotion& released() const { return released_; }

  /// None while it is open.
  const std::optional<ShotResult>& result() const { return result_; }

 private:
  void step_to(std::int64_t t_ns, std::span<const OpponentBody> opponents);
  double time_to_goal_s(const BallMotion& before, double dt_s) const;
  void meet_goal_plane(std::int64_t t_ns);
  bool keeper_has(const Crossing& crossing, double flown_s) const;
  bool passes(const PlanPoint& opponent, double dt_s) const;
  void meet_opponent(const PlanPoint& opponent, std::int64_t t_ns);
  void settle_short(std::int64_t t_ns);

  const Scenario& scenario_;
  BallMotion released_;
  BallMotion ball_;
  std::int64_t release_t_ns_;
  std::int64_t t_ns_;
  double farthest_y_m_;
  std::optional<ShotResult> result_;
};

}  // namespace trivela::sim
