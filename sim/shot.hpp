#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kicking/geometry/goal.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/outcome.hpp"
#include "kicking/random/draws.hpp"
#include "sim/guard.hpp"
#include "sim/kicker/flight.hpp"
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
  kicking::OptionalDouble margin_m;
  bool saved = false;    ///< on target, but the keeper had it
  bool bounced = false;  ///< touched the floor before the first of these
};

/// A released ball on its way to the goal. The goal frame is flat, in the plane of the goal line: what counts is where
/// the centre passes it. Post and bar throw the ball back, an opponent's body (a cylinder) turns it away; the first
/// thing met decides. A keeper stands at keeper_place(), defenders on their line; what they stop sim/guard.hpp says. A
/// ball that a defender stops is blocked. A keeper before its line stops only what would go in: it is on target, and
/// its crossing is where it would have gone.
class Shot {
 public:
  /// `scenario` must outlive the shot. `draws`: where defenders stand and what they and the keeper mistake.
  Shot(const Scenario& scenario, const BallMotion& released, std::int64_t t_ns, const kicking::Draws& draws = {0, 0});

  /// Moves the ball to t_ns, a control cycle ahead at most, while the opponents stand.
  void advance_to(std::int64_t t_ns, std::span<const OpponentBody> opponents);

  const BallMotion& ball() const { return ball_; }
  std::int64_t release_t_ns() const { return release_t_ns_; }
  const BallMotion& released() const { return released_; }

  /// Where a keeper that guesses is at t_ns, on its way from the release on; none: it waits and looks, or there is
  /// none.
  std::optional<PlanPoint> jumping_keeper(std::int64_t t_ns) const;

  /// None while it is open.
  const std::optional<ShotResult>& result() const { return result_; }

 private:
  struct Jump {
    double aim_m;
    GuardMotion motion;
  };

  void step_to(std::int64_t t_ns, std::span<const OpponentBody> opponents);
  BallMotion at_line(const BallMotion& before, double line_y_m, double dt_s, double& until_s) const;
  void meet_goal_plane(std::int64_t t_ns);
  Misjudgement keeper_misjudges() const;
  bool keeper_has(const Crossing& crossing, double flown_s) const;
  void meet_keeper_before_line(const BallMotion& before, std::int64_t before_t_ns, double dt_s);
  std::optional<ShotResult> would_go_in(BallMotion ball) const;
  void meet_defenders(const BallMotion& before, std::int64_t before_t_ns, double dt_s);
  void block(std::int64_t t_ns);
  bool passes(const PlanPoint& opponent, double dt_s) const;
  void meet_opponent(const PlanPoint& opponent, std::int64_t t_ns);
  void settle_short(std::int64_t t_ns);

  const Scenario& scenario_;
  kicking::Draws draws_;
  BallMotion released_;
  BallMotion ball_;
  std::int64_t release_t_ns_;
  std::int64_t t_ns_;
  double farthest_y_m_;
  std::optional<ShotResult> result_;
  mutable std::optional<Jump> jump_;  // of the keeper, as far as it was asked for
};

/// Where the keeper stands while the ball is at `ball_m`: `advance_m` before the goal line, between the ball and the
/// goal's middle.
PlanPoint keeper_place(const Scenario& scenario, const Eigen::Vector3d& ball_m);

/// Where defender `i` stands when a ball is shot from `ball_m`: where the line from the ball to the goal's middle
/// crosses theirs, give or take its spread.
PlanPoint defender_place(const Scenario& scenario, const kicking::Draws& draws, const Eigen::Vector3d& ball_m,
                         std::uint32_t i);

/// Distance of a crossing from the nearest edge beyond which kicking::classify() says something else [m]. The edges are
/// those of the bands in which the ball overlaps posts and bar, and the floor has none.
double margin_m(const Crossing& crossing, const kicking::Goal& goal, const kicking::Ball& ball);

}  // namespace trivela::sim
