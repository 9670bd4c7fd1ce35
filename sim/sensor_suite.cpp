#include "sim/sensor_suite.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trivela::sim {
namespace {

std::int64_t nanoseconds(double time_s) { return std::llround(time_s * 1e9); }

/// A point of F as the robot at `pose` sees it.
PlanPoint in_robot(const kicking::Pose& pose, double x_m, double y_m) {
  const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
  const double dx = x_m - pose.x_m, dy = y_m - pose.y_m;
  return {c * dx + s * dy, -s * dx + c * dy};
}

}  // namespace

void SensorSuite::begin(const Draws& draws) {
  draws_ = draws;
  cycle_ = 0;
  past_.clear();
  const Vision& v = scenario_.vision;
  const auto [x, y] = draws.normals(Role::kPoseSlow, 0, 0);
  slow_error_ = {v.position_slow_sd_m * x, v.position_slow_sd_m * y,
                 v.heading_slow_sd_rad * draws.normal(Role::kPoseSlow, 0, 1)};
}

void SensorSuite::remember(const World& world) {
  past_.push_back({world.t_ns(), world.body().pose(), world.ball_m(), world.opponent().position()});
  const double reach_s = std::max(scenario_.vision.latency_s, scenario_.flight_camera.latency_s) + scenario_.cycle_s;
  while (past_.front().t_ns < world.t_ns() - nanoseconds(reach_s)) past_.pop_front();
}

void SensorSuite::next_cycle() {
  ++cycle_;
  // First-order Gauss-Markov: e <- a e + sqrt(1 - a^2) sd n, a = exp(-T / tau).
  const Vision& v = scenario_.vision;
  const double keep = std::exp(-scenario_.cycle_s / v.slow_time_s), fresh = std::sqrt(1.0 - keep * keep);
  const auto [x, y] = draws_.normals(Role::kPoseSlow, cycle_, 0);
  const double heading = draws_.normal(Role::kPoseSlow, cycle_, 1);
  slow_error_ = {keep * slow_error_.x_m + fresh * v.position_slow_sd_m * x,
                 keep * slow_error_.y_m + fresh * v.position_slow_sd_m * y,
                 keep * slow_error_.heading_rad + fresh * v.heading_slow_sd_rad * heading};
}

std::optional<SensorSuite::Snapshot> SensorSuite::at(std::int64_t t_ns) const {
  const auto after = std::lower_bound(past_.begin(), past_.end(), t_ns,
                                      [](const Snapshot& snapshot, std::int64_t t) { return snapshot.t_ns < t; });
  if (after == past_.end()) return std::nullopt;
  if (after->t_ns == t_ns) return *after;
  if (after == past_.begin()) return std::nullopt;
  const Snapshot &a = *std::prev(after), &b = *after;
  const double part = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  const double turn = kicking::wrap_angle(b.pose.heading_rad - a.pose.heading_rad);
  return Snapshot{
      t_ns,
      {std::lerp(a.pose.x_m, b.pose.x_m, part), std::lerp(a.pose.y_m, b.pose.y_m, part),
       a.pose.heading_rad + part * turn},
      {std::lerp(a.ball.x, b.ball.x, part), std::lerp(a.ball.y, b.ball.y, part), std::lerp(a.ball.z, b.ball.z, part)},
      {std::lerp(a.opponent.x_m, b.opponent.x_m, part), std::lerp(a.opponent.y_m, b.opponent.y_m, part)}};
}

WheelSample SensorSuite::wheels(const World& world) const {
  const Robot& robot = scenario_.robot;
  const Odometry& noise = scenario_.odometry;
  const kicking::Twist twist = world.body().twist();
  WheelSample sample;
  sample.wheel_count = static_cast<int>(robot.wheel_angles_rad.size());
  for (std::size_t i = 0; i < robot.wheel_angles_rad.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const double angle = robot.wheel_angles_rad[i];
    const double rim_mps =
        -std::sin(angle) * twist.vx_mps + std::cos(angle) * twist.vy_mps + robot.wheel_distance_m * twist.omega_radps;
    const double scale = 1.0 + noise.slip_sd_ratio * draws_.normal(Role::kWheelSlip, 0, index);
    sample.wheel_radps[i] =
        rim_mps / robot.wheel_radius_m * scale + noise.wheel_sd_radps * draws_.normal(Role::kWheelNoise, cycle_, index);
  }
  sample.gyro_radps = twist.omega_radps + noise.gyro_bias_sd_radps * draws_.normal(Role::kGyroBias, 0) +
                      noise.gyro_sd_radps * draws_.normal(Role::kGyroNoise, cycle_);
  return sample;
}

VisionFrame SensorSuite::vision(const World& world) const {
  const Vision& v = scenario_.vision;
  VisionFrame frame{.t_exposure_ns = world.t_ns() - nanoseconds(v.latency_s), .pose = {}, .ball = {}, .opponent = {}};
  const auto seen = at(frame.t_exposure_ns);
  if (!seen) return frame;
  const auto kept = [&](std::uint32_t index) {
    return draws_.uniform(Role::kVisionDropout, cycle_, index) >= v.dropout_ratio;
  };
  if (kept(0)) {
    const auto [x, y] = draws_.normals(Role::kPoseNoise, cycle_, 0);
    const double heading = draws_.normal(Role::kPoseNoise, cycle_, 1);
    frame.pose = kicking::Pose{
        seen->pose.x_m + slow_error_.x_m + v.position_white_sd_m * x,
        seen->pose.y_m + slow_error_.y_m + v.position_white_sd_m * y,
        kicking::wrap_angle(seen->pose.heading_rad + slow_error_.heading_rad + v.heading_white_sd_rad * heading)};
  }
  const PlanPoint ball = in_robot(seen->pose, seen->ball.x, seen->ball.y);
  const double ball_distance = std::hypot(ball.x_m, ball.y_m);
  if (kept(1) && ball_distance <= v.ball_range_m && seen->ball.z <= v.ball_height_max_m) {
    const auto [x, y] = draws_.normals(Role::kBallNoise, cycle_);
    const double sd = v.ball_sd_m + v.ball_sd_ratio * ball_distance;
    frame.ball = PlanPoint{ball.x_m + sd * x, ball.y_m + sd * y};
  }
  const PlanPoint opponent = in_robot(seen->pose, seen->opponent.x_m, seen->opponent.y_m);
  if (kept(2) && std::hypot(opponent.x_m, opponent.y_m) <= v.opponent_range_m) {
    const auto [x, y] = draws_.normals(Role::kOpponentNoise, cycle_);
    frame.opponent = PlanPoint{opponent.x_m + v.opponent_sd_m * x, opponent.y_m + v.opponent_sd_m * y};
  }
  return frame;
}

FlightFrame SensorSuite::flight(const World& world) const {
  const FlightCamera& c = scenario_.flight_camera;
  FlightFrame frame{.t_exposure_ns = world.t_ns() - nanoseconds(c.latency_s), .ball = {}};
  const auto seen = at(frame.t_exposure_ns);
  if (!seen || draws_.uniform(Role::kFlightDropout, cycle_) < c.dropout_ratio) return frame;
  const auto [x, y] = draws_.normals(Role::kFlightNoise, cycle_, 0);
  const double z = draws_.normal(Role::kFlightNoise, cycle_, 1);
  frame.ball = FlightFrame::Point{seen->ball.x + c.position_sd_m * x, seen->ball.y + c.position_sd_m * y,
                                  seen->ball.z + c.position_sd_m * z};
  return frame;
}

}  // namespace trivela::sim
