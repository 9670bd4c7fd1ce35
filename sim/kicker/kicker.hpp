#pragma once

#include <cstdint>
#include <optional>

#include "kicking/geometry/frames.hpp"
#include "kicking/random/draws.hpp"
#include "sim/commands.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// The kicker of one of our robots, counted from 1, on the day of its calibration: that of the scenario with the
/// robot's own speeds.
Kicker team_kicker(const Scenario& scenario, std::uint32_t robot);

/// The same in the match of that seed: its speeds have drifted by one factor 1 + N(0, drift_sd_ratio).
Kicker match_kicker(const Scenario& scenario, std::uint32_t robot, std::uint64_t seed);

/// Of the speeds that this kicker began with, what it has after so many kicks: 1, or 1 - drop_ratio from
/// drop_after_kicks on.
double worn_ratio(const Kicker& kicker, std::uint32_t kicks);

/// The kicker with its lever for that kind of kick: 0 is the lob, any other the flat kick where there is one.
Kicker kicker_of_kind(const Kicker& kicker, std::size_t kind);

/// Speed and elevation with which a ball leaves the robot at rest.
struct Exit {
  double speed_mps = 0.0;
  double elevation_rad = 0.0;
};

/// The true exit at `power`: linear between the table's set-points, clamped to its ends.
Exit exit_at(const Kicker& kicker, double power);

/// What the paper's calibration makes of a true exit: fly it with drag back to the height it left from, measure apex H
/// and range D, and read theta = atan(4 H / D), v = sqrt(D g / sin 2 theta) (paper, section 2). Without drag it is the
/// identity. Throws std::runtime_error for an elevation outside (0, pi/2) or a speed that is not positive.
Exit effective_exit(const Exit& true_exit, const BallPhysics& ball);

/// The true exit whose effective_exit() is `effective`: how the default table of Kicker follows from the published map.
Exit true_exit(const Exit& effective, const BallPhysics& ball);

/// One energised coil on its way to the ball.
struct Stroke {
  std::int64_t kick_id = 0;
  std::int64_t release_t_ns = 0;
  double exit_speed_mps = 0.0;
  double exit_elevation_rad = 0.0;
  double deflection_rad = 0.0;  ///< of the direction, counter-clockwise
  bool live = false;            ///< the ball was in the handler and the game on when the coil was energised
};

/// The kicker: capacitor, coil, plunger and lever. A kick of exit speed v takes charge_per_kick (v / v_top)^2 of the
/// capacitor; with less than that left the ball leaves slower, by the square root of what is there.
class KickerDevice {
 public:
  explicit KickerDevice(const Kicker& values);

  /// A full capacitor, no kick under way, the lever at the lob, and the table's speeds times `speed_scale_ratio`.
  void reset(double speed_scale_ratio);

  double charge() const { return charge_; }
  const std::optional<Stroke>& stroke() const { return stroke_; }

  /// Takes a fire order, to be energised at its instant. Ignored if the power is not finite, or while a kick is under
  /// way.
  void order(const Fire& fire);

  /// The lever shall stand for that kind. Ignored while it moves, and where the kicker has no such kind.
  void lever(std::uint8_t kind, std::int64_t t_ns);
  /// Kind that it stands for; kicking::kLeverMoves: for none.
  std::uint8_t lever_kind(std::int64_t t_ns) const;

  /// Instant at which something happens next: the coil is energised or the plunger reaches the ball.
  std::optional<std::int64_t> next_event_t_ns() const;

  /// Energises an order that is due at t_ns; `live` as in Stroke. Attempt n of an opportunity has its own noise.
  void energise_due(std::int64_t t_ns, bool live, const kicking::Draws& draws, std::uint32_t attempt);

  /// The stroke that reaches the ball at t_ns or before, once.
  std::optional<Stroke> take_released(std::int64_t t_ns);

  void recharge(double dt_s);

 private:
  Kicker values_;
  Kicker flat_;
  std::uint8_t lever_from_ = 0;
  std::uint8_t lever_to_ = 0;
  std::int64_t lever_stands_t_ns_ = 0;  // there
  double charge_ = 1.0;
  std::optional<Fire> order_;
  std::optional<Stroke> stroke_;
};

/// The ball that a stroke sends off: exit velocity along the heading, plus the velocity of the ball's point of the
/// robot, v + omega x r, of which the ball keeps the transfer ratios. `radius_m`: height at which the ball leaves.
BallMotion release(const Stroke& stroke, const kicking::Pose& pose, const kicking::Twist& twist, const Kicker& kicker,
                   double ball_offset_m, double radius_m);

}  // namespace trivela::sim
