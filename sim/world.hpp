#pragma once

#include <cstdint>
#include <optional>

#include "kicking/random/draws.hpp"
#include "sim/commands.hpp"
#include "sim/kicker/kicker.hpp"
#include "sim/opponent_body.hpp"
#include "sim/opportunity.hpp"
#include "sim/robot_body.hpp"
#include "sim/scenario.hpp"
#include "sim/shot.hpp"

namespace trivela::sim {

/// Robot, kicker, ball and opponents: the physics, without a referee.
class World {
 public:
  /// `scenario` must outlive the world.
  explicit World(const Scenario& scenario);

  /// A new opportunity: its robot stands at its start with the ball, the opponents at theirs. Its kicker has the
  /// table's speeds times `speed_scale_ratio`, its capacitor is full, and what it was about to do is forgotten: the
  /// stop of a real match is long enough. `draws` supplies the kicker's noise.
  void place(const Opportunity& opportunity, double speed_scale_ratio, const kicking::Draws& draws);

  /// Play starts: the robot has the opportunity's velocity and the opponents come.
  void start_play(const Opportunity& opportunity);

  /// The referee stops the game: the robot brakes, the opponents stand, no kick counts.
  void stop_play();

  /// Takes the robot's commands; the base obeys while the game is on.
  void command(const Commands& commands);

  /// Moves everything to t_ns, with the coil's events at their instants.
  void advance_to(std::int64_t t_ns);

  std::int64_t t_ns() const { return t_ns_; }
  const RobotBody& body() const { return body_; }
  const KickerDevice& kicker() const { return kicker_; }
  const Opponents& opponents() const { return opponents_; }

  /// The flight of this opportunity's kick and its id; none while the robot holds the ball.
  const std::optional<Shot>& shot() const { return shot_; }
  std::int64_t shot_kick_id() const { return shot_kick_id_; }

  /// The ball's centre in F.
  Eigen::Vector3d ball_m() const;

 private:
  void coil_events();
  void move(std::int64_t t_ns);

  const Scenario& scenario_;
  std::int64_t t_ns_ = 0;
  bool playing_ = false;
  RobotBody body_;
  KickerDevice kicker_;
  Opponents opponents_;
  kicking::Draws draws_{0, 0};
  std::uint32_t attempts_ = 0;
  std::optional<Shot> shot_;
  std::int64_t shot_kick_id_ = 0;
};

}  // namespace trivela::sim
