#include "sim/sensor_suite.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::sim {
namespace {

/// A point of F as the robot at `pose` sees it.
PlanPoint in_robot(const kicking::Pose& pose, const PlanVector& axis, double x_m, double y_m) {
  const double dx = x_m - pose.x_m, dy = y_m - pose.y_m;
  return {axis.c * dx + axis.s * dy, -axis.s * dx + axis.c * dy};
}

double length(const PlanPoint& point) { return std::sqrt(point.x_m * point.x_m + point.y_m * point.y_m); }

/// As many snapshots as lie within the longest latency and a cycle.
std::size_t snapshots(const Scenario& scenario) {
  const double reach_s = std::max(scenario.vision.latency_s, scenario.flight_camera.latency_s) + scenario.cycle_s;
  const double step_s = scenario.cycle_s / std::ceil(scenario.cycle_s / scenario.substep_s - 1e-9);
  return static_cast<std::size_t>(std::ceil(reach_s / step_s)) + 2;
}

}  // namespace

SensorSuite::SensorSuite(const Scenario& scenario)
    : scenario_(scenario),
      vision_latency_ns_(kicking::nanoseconds(scenario.vision.latency_s)),
      flight_latency_ns_(kicking::nanoseconds(scenario.flight_camera.latency_s)),
      flight_period_ns_(kicking::nanoseconds(scenario.flight_camera.period_s)),
      cycle_ns_(kicking::nanoseconds(scenario.cycle_s)),
      slow_keep_(std::exp(-scenario.cycle_s / scenario.vision.slow_time_s)),
      slow_fresh_(std::sqrt(1.0 - slow_keep_ * slow_keep_)),
      past_(snapshots(scenario)) {
  const Robot& robot = scenario.robot;
  for (const double angle : robot.wheel_angles_rad) {
    wheels_.push_back({-std::sin(angle) / robot.wheel_radius_m, std::cos(angle) / robot.wheel_radius_m,
                       robot.wheel_distance_m / robot.wheel_radius_m});
  }
}

void SensorSuite::begin(const kicking::Draws& draws) {
  draws_ = draws;
  cycle_ = 0;
  kept_ = 0;
  const Odometry& o = scenario_.odometry;
  wheel_scale_ = draws.normals(kicking::Role::kWheelSlip, 0);
  for (double& scale : wheel_scale_) scale = 1.0 + o.slip_sd_ratio * scale;
  gyro_bias_radps_ = o.gyro_bias_sd_radps * draws.normal(kicking::Role::kGyroBias, 0);
  const Vision& v = scenario_.vision;
  const auto [x, y, heading, spare] = draws.normals(kicking::Role::kPoseSlow, 0);
  slow_error_ = {v.position_slow_sd_m * x, v.position_slow_sd_m * y, v.heading_slow_sd_rad * heading};
  slow_cycle_ = 0;
}

void SensorSuite::remember(const World& world) {
  newest_ = newest_ + 1 < past_.size() ? newest_ + 1 : 0;
  kept_ = std::min(kept_ + 1, past_.size());
  Snapshot& now = past_[newest_];
  const OpponentBody& nearest = world.opponents().nearest();
  now.t_ns = world.t_ns();
  now.pose = world.body().pose();
  now.axis = world.body().axis();
  now.ball = world.ball_m();
  now.opponent = nearest.position();
  now.jumping_keeper = world.shot() ? world.shot()->jumping_keeper(world.t_ns()) : std::nullopt;
  further_count_ = 0;
  const auto add = [&](const PlanPoint& place) {
    if (further_count_ < kMostFurther) now.further[further_count_++] = place;
  };
  for (const OpponentBody& body : world.opponents().all()) {
    if (&body != &nearest) add(body.position());
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(scenario_.defenders.count); ++i)
    add(defender_place(scenario_, draws_, world.ball_m(), i));
}

void SensorSuite::next_cycle() { ++cycle_; }

const kicking::Pose& SensorSuite::slow_error() const {
  // First-order Gauss-Markov: e <- a e + sqrt(1 - a^2) sd n, a = exp(-T / tau).
  const Vision& v = scenario_.vision;
  while (slow_cycle_ < cycle_) {
    const auto [x, y, heading, spare] = draws_.normals(kicking::Role::kPoseSlow, ++slow_cycle_);
    slow_error_ = {slow_keep_ * slow_error_.x_m + slow_fresh_ * v.position_slow_sd_m * x,
                   slow_keep_ * slow_error_.y_m + slow_fresh_ * v.position_slow_sd_m * y,
                   slow_keep_ * slow_error_.heading_rad + slow_fresh_ * v.heading_slow_sd_rad * heading};
  }
  return slow_error_;
}

const SensorSuite::Snapshot* SensorSuite::at(std::int64_t t_ns) const {
  const Snapshot* after = nullptr;
  for (std::size_t i = 0; i < kept_; ++i) {
    const Snapshot& before = past_[newest_ >= i ? newest_ - i : newest_ + past_.size() - i];
    if (before.t_ns == t_ns) return &before;
    if (before.t_ns < t_ns) return after ? &(between_ = between(before, *after, t_ns)) : nullptr;
    after = &before;
  }
  return nullptr;
}

SensorSuite::Snapshot SensorSuite::between(const Snapshot& a, const Snapshot& b, std::int64_t t_ns) {
  const double part = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  const double heading = a.pose.heading_rad + part * kicking::wrap_angle(b.pose.heading_rad - a.pose.heading_rad);
  return {t_ns,
          {std::lerp(a.pose.x_m, b.pose.x_m, part), std::lerp(a.pose.y_m, b.pose.y_m, part), heading},
          {std::cos(heading), std::sin(heading)},
          {std::lerp(a.ball.x(), b.ball.x(), part), std::lerp(a.ball.y(), b.ball.y(), part),
           std::lerp(a.ball.z(), b.ball.z(), part)},
          {std::lerp(a.opponent.x_m, b.opponent.x_m, part), std::lerp(a.opponent.y_m, b.opponent.y_m, part)},
          b.further,  // who of them is which may change between the two
          b.jumping_keeper};
}

WheelSample SensorSuite::wheels(const World& world) const {
  const Odometry& noise = scenario_.odometry;
  const kicking::Twist twist = world.body().twist();
  const auto [gyro, first, second, third] = draws_.normals(kicking::Role::kOdometryNoise, cycle_);
  const double fourth = wheels_.size() > 3 ? draws_.normal(kicking::Role::kOdometryNoise, cycle_, 1) : 0.0;
  const std::array<double, 4> white{first, second, third, fourth};
  WheelSample sample;
  sample.wheel_count = static_cast<int>(wheels_.size());
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const auto& [vx, vy, omega] = wheels_[i];
    const double turns_radps = vx * twist.vx_mps + vy * twist.vy_mps + omega * twist.omega_radps;
    sample.wheel_radps[i] = turns_radps * wheel_scale_[i] + noise.wheel_sd_radps * white[i];
  }
  sample.gyro_radps = twist.omega_radps + gyro_bias_radps_ + noise.gyro_sd_radps * gyro;
  return sample;
}

VisionFrame SensorSuite::vision(const World& world) const {
  const Vision& v = scenario_.vision;
  VisionFrame frame{
      .t_exposure_ns = world.t_ns() - vision_latency_ns_, .pose = {}, .ball = {}, .opponent = {}, .keeper = {}};
  const Snapshot* const seen = at(frame.t_exposure_ns);
  if (!seen) return frame;
  const auto [pose_luck, ball_luck, opponent_luck, spare] = draws_.uniforms(kicking::Role::kVisionDropout, cycle_);
  if (pose_luck >= v.dropout_ratio) {
    const auto [x, y, heading, unused] = draws_.normals(kicking::Role::kPoseNoise, cycle_);
    const kicking::Pose& slow = slow_error();
    frame.pose = kicking::Pose{
        seen->pose.x_m + slow.x_m + v.position_white_sd_m * x, seen->pose.y_m + slow.y_m + v.position_white_sd_m * y,
        kicking::wrap_angle(seen->pose.heading_rad + slow.heading_rad + v.heading_white_sd_rad * heading)};
  }
  const auto [ball_x, ball_y, opponent_x, opponent_y] = draws_.normals(kicking::Role::kSightNoise, cycle_);
  const PlanPoint ball = in_robot(seen->pose, seen->axis, seen->ball.x(), seen->ball.y());
  const double ball_distance = length(ball);
  if (ball_luck >= v.dropout_ratio && ball_distance <= v.ball_range_m && seen->ball.z() <= v.ball_height_max_m) {
    const double sd = v.ball_sd_m + v.ball_sd_ratio * ball_distance;
    frame.ball = PlanPoint{ball.x_m + sd * ball_x, ball.y_m + sd * ball_y};
  }
  const PlanPoint opponent = in_robot(seen->pose, seen->axis, seen->opponent.x_m, seen->opponent.y_m);
  if (opponent_luck >= v.dropout_ratio && length(opponent) <= v.opponent_range_m) {
    frame.opponent =
        PlanPoint{opponent.x_m + v.opponent_sd_m * opponent_x, opponent.y_m + v.opponent_sd_m * opponent_y};
  }
  if (further_count_ > 0) see_further(*seen, frame);
  if (scenario_.keeper.enabled) frame.keeper = keeper(*seen, spare);
  return frame;
}

void SensorSuite::see_further(const Snapshot& seen, VisionFrame& frame) const {
  const Vision& v = scenario_.vision;
  for (std::uint32_t i = 0; i < further_count_; ++i) {
    const PlanPoint there = in_robot(seen.pose, seen.axis, seen.further[i].x_m, seen.further[i].y_m);
    const double luck = draws_.uniform(kicking::Role::kFurtherSight, cycle_, kMostFurther + i);
    if (luck < v.dropout_ratio || length(there) > v.opponent_range_m) continue;
    const auto [x, y, unused, more] = draws_.normals(kicking::Role::kFurtherSight, cycle_, i);
    frame.further[frame.further_count++] = {there.x_m + v.opponent_sd_m * x, there.y_m + v.opponent_sd_m * y};
  }
}

std::optional<PlanPoint> SensorSuite::keeper(const Snapshot& seen, double luck) const {
  const Vision& v = scenario_.vision;
  const PlanPoint place = seen.jumping_keeper.value_or(keeper_place(scenario_, seen.ball));
  const PlanPoint there = in_robot(seen.pose, seen.axis, place.x_m, place.y_m);
  if (luck < v.dropout_ratio || length(there) > v.opponent_range_m) return std::nullopt;
  const auto [x, y, unused, more] = draws_.normals(kicking::Role::kKeeperSight, cycle_);
  return PlanPoint{there.x_m + v.opponent_sd_m * x, there.y_m + v.opponent_sd_m * y};
}

FlightFrame SensorSuite::flight(const World& world) const {
  const FlightCamera& c = scenario_.flight_camera;
  FlightFrame frame{.t_exposure_ns = world.t_ns() - flight_latency_ns_, .ball = {}};
  if (flight_period_ns_ > cycle_ns_ && frame.t_exposure_ns >= 0) {
    const std::int64_t since_ns = frame.t_exposure_ns % flight_period_ns_;
    if (since_ns >= cycle_ns_) return frame;  // the camera has not exposed since the last cycle
    frame.t_exposure_ns -= since_ns;
  }
  const Snapshot* const seen = at(frame.t_exposure_ns);
  if (!seen || draws_.uniform(kicking::Role::kFlightDropout, cycle_) < c.dropout_ratio) return frame;
  const auto [x, y, z, spare] = draws_.normals(kicking::Role::kFlightNoise, cycle_);
  frame.ball = FlightFrame::Point{seen->ball.x() + c.bias_x_m + c.position_sd_m * x,
                                  seen->ball.y() + c.bias_y_m + c.position_sd_m * y,
                                  seen->ball.z() + c.bias_z_m + c.position_sd_m * z};
  return frame;
}

}  // namespace trivela::sim
