#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/geometry/frames.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/opponents.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::sim {

/// Where the ball's centre passed the plane of the goal line, in F.
struct Crossing {
  double x_m = 0.0;
  double z_m = 0.0;
};

/// What became of a kick; one row per ball released.
struct KickTruth {
  std::int64_t t_ns = 0;  ///< when it was settled
  std::int64_t kick_id = 0;
  int half = 1;
  std::uint32_t possession_id = 0;
  kicking::Outcome outcome{};
  std::optional<Crossing> crossing;
  bool saved = false;    ///< on target, but the keeper had it
  bool bounced = false;  ///< touched the floor before that, or before the goal line
  std::int64_t release_t_ns = 0;
  Eigen::Vector3d release_position_m{0.0, 0.0, 0.0};    ///< ball centre
  Eigen::Vector3d release_velocity_mps{0.0, 0.0, 0.0};  ///< over ground
  /// Distance of the crossing from the nearest edge that would change the outcome; for a short ball, of its nearest
  /// point from the goal line; none for a blocked one.
  kicking::OptionalDouble margin_m;
};

/// kStopped: the referee whistled.
enum class PossessionEnd { kKicked, kDisputed, kTimedOut, kStopped };
inline constexpr std::array kPossessionEndNames{"kicked", "disputed", "timed_out", "stopped"};

/// How a possession ended.
struct PossessionTruth {
  std::int64_t t_ns = 0;
  int half = 1;
  std::uint32_t possession_id = 0;
  PossessionEnd ending = PossessionEnd::kTimedOut;
  std::uint8_t robot = 1;       ///< which of ours
  std::int64_t start_t_ns = 0;  ///< play started
  kicking::Pose start;          ///< robot in F at that instant
};

/// The world as it is at an instant.
struct TrueState {
  kicking::Pose pose;
  kicking::Twist twist;               ///< in R
  bool ball_held = false;             ///< no ball has left in this possession
  double charge = 1.0;                ///< capacitor energy, 0..1
  std::uint8_t lever_kind = 0;        ///< kind of kick that the lever stands for; kicking::kLeverMoves: it moves
  double opponent_distance_m = 0.0;   ///< from the ball; of whoever is there first
  double opponent_closing_mps = 0.0;  ///< its rate
  std::array<kicking::BodyPlace, kicking::kMostBodies> opponents{};
  std::size_t opponent_count = 0;
  kicking::OptionalDouble keeper_x_m;  ///< the opponents' keeper along its line; none: there is none
  std::int64_t dispute_t_ns = 0;       ///< when an opponent is at the ball, if it stays
};

/// What was settled during one step.
struct StepEvents {
  std::vector<KickTruth> kicks;
  std::vector<PossessionTruth> possessions;
};

}  // namespace trivela::sim
