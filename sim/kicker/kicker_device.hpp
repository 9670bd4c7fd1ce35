#pragma once

#include <cstdint>
#include <optional>

#include "kicking/geometry/frames.hpp"
#include "kicking/random/draws.hpp"
#include "sim/commands.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

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
