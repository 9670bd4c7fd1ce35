#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "robot/belief/ball_filter.hpp"
#include "robot/belief/decay.hpp"
#include "robot/belief/gain_count.hpp"
#include "robot/belief/pose_filter.hpp"

namespace trivela::robot {

/// The robot's belief, made from odometry, vision and the referee: messages in, WorldState out, no bus.
class WorldModel {
 public:
  /// `ball_offset_m`: robot centre to the ball in the handler.
  WorldModel(const config::WorldState& settings, double ball_offset_m)
      : settings_(settings),
        pose_(settings),
        ball_(settings, ball_offset_m),
        velocity_decay_(settings.velocity_time_constant_s) {}

  /// A frame, once; a second call with the same exposure changes nothing.
  void vision(const msg::VisionFrame& frame);

  /// The belief at the instant of `odometry`. `frame` is the newest vision frame, nullptr where there is none, and
  /// `referee` his latest word: pictures older than odometry correct the past, so that the pose holds now. A robot that
  /// has not localised itself yet does not play, nor does one in a cycle whose odometry is not finite or farther off
  /// than any robot drives, which changes no belief. Where no frame came for longer, the ball is forgotten as if it had
  /// not been seen. A referee who counts no possessions (0) leaves it to the robot to count its own.
  msg::WorldState update(const msg::Odometry& odometry, const msg::VisionFrame* frame, const msg::Referee* referee);

 private:
  void filter_velocity(const msg::Odometry& odometry);
  void describe_ball(const kicking::TurnedPose& pose, std::int64_t t_ns, msg::WorldState& out);

  config::WorldState settings_;
  PoseFilter pose_;
  BallFilter ball_;
  GainCount gains_;
  Decay velocity_decay_;
  kicking::Twist twist_{};
  std::int64_t twist_t_ns_ = 0;
  std::int64_t last_exposure_ns_ = 0;
  std::optional<Eigen::Vector2d> opponent_m_;  // in R
  std::int64_t opponent_t_ns_ = 0;
};

}  // namespace trivela::robot
