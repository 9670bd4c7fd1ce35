#include "robot/belief/world_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

using kicking::TurnedPose;

namespace {

const TurnedPose kOrigin;
constexpr double kSeen_m = 0.15;  // standard deviation of a robot in a picture; match log of 2016: 0.14 m an axis

/// Neither NaN nor farther from 0 than any robot comes.
bool healthy(const msg::Odometry& odometry) {
  constexpr double kFastest = 1e3;   // m/s, rad/s
  constexpr double kFarthest = 1e6;  // m, rad, and their variances
  const auto within = [](double limit, std::initializer_list<double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [limit](double x) { return std::abs(x) <= limit; });
  };
  return within(kFastest, {odometry.vx_mps, odometry.vy_mps, odometry.omega_radps}) &&
         within(kFarthest, {odometry.x_m, odometry.y_m, odometry.heading_rad, odometry.var_position_m2,
                            odometry.var_heading_rad2});
}

/// The tracked opponents at t_ns; NaN where there is none.
void describe(const OpponentTracks& opponents, std::int64_t t_ns, msg::WorldState& out) {
  for (std::size_t i = 0; i < kicking::kMostBodies; ++i) {
    out.opponent_x_m[i] = out.opponent_y_m[i] = out.opponent_vx_mps[i] = out.opponent_vy_mps[i] = msg::kNone;
    out.opponent_sd_m[i] = out.opponent_sd_mps[i] = msg::kNone;
  }
  for (const OpponentTrack& track : opponents.tracks()) {
    const OpponentTrack now = track.at(t_ns);
    const std::size_t i = out.opponent_count++;
    out.opponent_x_m[i] = now.position_m.x();
    out.opponent_y_m[i] = now.position_m.y();
    out.opponent_vx_mps[i] = now.velocity_mps.x();
    out.opponent_vy_mps[i] = now.velocity_mps.y();
    out.opponent_sd_m[i] = std::sqrt(now.var_m2);
    out.opponent_sd_mps[i] = std::sqrt(now.var_m2ps2);
  }
}

}  // namespace

std::uint32_t WorldModel::count(std::int64_t t_ns, const msg::Referee& word, bool possession) {
  return possessions_.see({.t_ns = t_ns,
                           .half = word.half,
                           .playing = word.playing,
                           .half_time_s = word.half_time_s,
                           .possession = possession,
                           .kick_id = kick_id_});
}

void WorldModel::receive(const msg::Referee& word) { count(word.t_ns, word, false); }

msg::WorldState WorldModel::update(const msg::Odometry& odometry, const msg::VisionFrame* frame,
                                   const msg::Referee* referee, const msg::KickerStatus* kicker) {
  const bool believed = healthy(odometry);
  if (believed) {
    const double dt_s = kicking::seconds(odometry.t_ns - twist_t_ns_);
    const double gain = dt_s <= 0.0 ? 1.0 : velocity_decay_.gain(dt_s);
    twist_.vx_mps += gain * (odometry.vx_mps - twist_.vx_mps);
    twist_.vy_mps += gain * (odometry.vy_mps - twist_.vy_mps);
    twist_.omega_radps += gain * (odometry.omega_radps - twist_.omega_radps);
    twist_t_ns_ = odometry.t_ns;
    pose_.predict(odometry.t_ns, {odometry.x_m, odometry.y_m, odometry.heading_rad}, odometry.var_position_m2,
                  odometry.var_heading_rad2);
  }
  if (frame && frame->t_exposure_ns > last_exposure_ns_) {
    last_exposure_ns_ = frame->t_exposure_ns;
    if (frame->pose_seen) pose_.correct(frame->t_exposure_ns, {frame->x_m, frame->y_m, frame->heading_rad});
    ball_.observe(frame->t_exposure_ns,
                  frame->ball_seen ? std::optional{Eigen::Vector2d{frame->ball_x_m, frame->ball_y_m}} : std::nullopt);
    if (frame->opponent_seen) {
      opponent_m_ = Eigen::Vector2d{frame->opponent_x_m, frame->opponent_y_m};
      opponent_t_ns_ = frame->t_exposure_ns;
    } else if (kicking::seconds(frame->t_exposure_ns - opponent_t_ns_) > settings_.ball_forget_s) {
      opponent_m_.reset();
    }
    if (tracks_opponents_) see_opponents(*frame);
    if (frame->keeper_seen) see_keeper(*frame);
  }
  if (frame) ball_.silence(kicking::seconds(odometry.t_ns - frame->t_ns));
  msg::WorldState out = describe(odometry.t_ns);
  out.half = referee ? referee->half : 0;
  out.playing = believed && pose_.pose() && referee && referee->playing;
  if (kicker && kicker->last_accepted) kick_id_ = kicker->last_kick_id;
  if (referee) out.possession_id = count(out.t_ns, *referee, out.possession);
  return out;
}

void WorldModel::see_opponents(const msg::VisionFrame& frame) {
  const auto pose = pose_.pose_at(frame.t_exposure_ns);
  if (!pose) return;
  std::array<Eigen::Vector2d, kicking::kMostBodies> seen_m;
  std::size_t count = 0;
  if (frame.opponent_seen) seen_m[count++] = pose->to_field(frame.opponent_x_m, frame.opponent_y_m);
  const std::size_t further = std::min<std::size_t>(frame.further_count, std::size(frame.further_x_m));
  for (std::size_t i = 0; i < further; ++i)
    seen_m[count++] = pose->to_field(frame.further_x_m[i], frame.further_y_m[i]);
  opponents_.observe(frame.t_exposure_ns, {seen_m.data(), count}, kSeen_m);
}

void WorldModel::see_keeper(const msg::VisionFrame& frame) {
  const auto pose = pose_.pose_at(frame.t_exposure_ns);
  if (!pose) return;
  const double distance_m = std::hypot(frame.keeper_x_m, frame.keeper_y_m);
  keeper_.observe(frame.t_exposure_ns, pose->to_field(frame.keeper_x_m, frame.keeper_y_m).x(),
                  std::hypot(kSeen_m, pose_.sd_position_m(), distance_m * pose_.sd_heading_rad()));
}

msg::WorldState WorldModel::describe(std::int64_t t_ns) const {
  const TurnedPose* const localised = pose_.pose();
  const TurnedPose& pose = localised ? *localised : kOrigin;
  // What moves with nobody stands where it was seen.
  const auto seen_from = [&](std::int64_t seen_t_ns) { return pose_.pose_at(seen_t_ns).value_or(pose); };
  msg::WorldState out{};
  out.t_ns = t_ns;
  out.x_m = pose.x_m;
  out.y_m = pose.y_m;
  out.heading_rad = pose.heading_rad;
  out.vx_mps = twist_.vx_mps;
  out.vy_mps = twist_.vy_mps;
  out.omega_radps = twist_.omega_radps;
  out.sd_position_m = pose_.sd_position_m();
  out.sd_heading_rad = pose_.sd_heading_rad();
  out.ball_x_m = out.ball_y_m = out.ball_vx_mps = out.ball_vy_mps = out.ball_age_s = out.opponent_distance_m =
      out.keeper_x_m = out.keeper_sd_m = msg::kNone;
  robot::describe(opponents_, t_ns, out);
  if (const auto keeper = keeper_.at(t_ns)) {
    out.keeper_x_m = keeper->x_m;
    out.keeper_sd_m = keeper->sd_m;
  }
  out.possession = ball_.possession();
  const auto& ball = ball_.position_m();
  out.ball_known = ball.has_value();
  if (!ball) return out;
  // A held ball moves with the robot.
  const Eigen::Vector2d in_field = out.possession ? pose.to_field(ball->x(), ball->y())
                                                  : seen_from(ball_.seen_t_ns()).to_field(ball->x(), ball->y());
  out.ball_x_m = in_field.x();
  out.ball_y_m = in_field.y();
  out.ball_age_s = kicking::seconds(t_ns - ball_.seen_t_ns());
  if (out.possession) {
    const Eigen::Vector2d velocity =
        pose.turn(twist_.vx_mps - twist_.omega_radps * ball->y(), twist_.vy_mps + twist_.omega_radps * ball->x());
    out.ball_vx_mps = velocity.x();
    out.ball_vy_mps = velocity.y();
  }
  if (opponent_m_)
    out.opponent_distance_m =
        (seen_from(opponent_t_ns_).to_field(opponent_m_->x(), opponent_m_->y()) - in_field).norm();
  return out;
}

}  // namespace trivela::robot
