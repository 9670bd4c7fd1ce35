#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "robot/belief/ball_filter.hpp"
#include "robot/belief/opponent_tracks.hpp"
#include "robot/belief/pose_filter.hpp"
#include "robot/belief/possession_count.hpp"

namespace trivela::robot {

/// The robot's belief, made from odometry, vision and the referee: messages in, WorldState out, no bus.
class WorldModel {
 public:
  /// `ball_offset_m`: robot centre to the ball in the handler. `tracks_opponents`: whether somebody reads where they
  /// are; the distance of the nearest is known all the same.
  WorldModel(const config::WorldState& settings, double ball_offset_m, bool tracks_opponents = true)
      : settings_(settings),
        tracks_opponents_(tracks_opponents),
        pose_(settings),
        ball_(settings, ball_offset_m),
        velocity_decay_(settings.velocity_time_constant_s) {}

  /// The referee's word in a cycle in which the robot is not asked for its belief.
  void receive(const msg::Referee& word);

  /// The belief at the instant of `odometry`. `frame` is the newest vision frame, nullptr where there is none, and
  /// counts once; `referee` its latest command: pictures older than odometry correct the past, so that the pose holds
  /// now. A robot that has not localised itself yet does not play. Odometry that is not finite, or farther off than any
  /// robot drives, changes no belief, and the robot does not play in that cycle. Where no frame came for longer, the
  /// ball is forgotten as if it had not been seen. The possessions are the robot's own count, whatever the referee
  /// numbers; `kicker` says which kick ended one (nullptr: none).
  msg::WorldState update(const msg::Odometry& odometry, const msg::VisionFrame* frame, const msg::Referee* referee,
                         const msg::KickerStatus* kicker = nullptr);

 private:
  std::uint32_t count(std::int64_t t_ns, const msg::Referee& word, bool possession);
  /// The keeper in a picture, where the robot then was.
  void see_keeper(const msg::VisionFrame& frame);
  /// The other opponents in a picture, the same.
  void see_opponents(const msg::VisionFrame& frame);
  /// What is believed of robot, ball and opponent, all predicted to t_ns.
  msg::WorldState describe(std::int64_t t_ns) const;

  config::WorldState settings_;
  bool tracks_opponents_;
  PoseFilter pose_;
  BallFilter ball_;
  PossessionCount possessions_;
  std::int64_t kick_id_ = 0;  // the last one that the driver accepted
  Decay velocity_decay_;
  kicking::Twist twist_{};
  std::int64_t twist_t_ns_ = 0;
  std::int64_t last_exposure_ns_ = 0;
  std::optional<Eigen::Vector2d> opponent_m_;  // in R
  std::int64_t opponent_t_ns_ = 0;
  KeeperTrack keeper_;
  OpponentTracks opponents_;
};

}  // namespace trivela::robot
