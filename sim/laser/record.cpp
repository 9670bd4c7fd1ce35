#include "sim/laser/record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/random/draws.hpp"
#include "sim/kicker/flight.hpp"

namespace trivela::sim {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;

/// The scanner and the ball in front of it, step by step.
class Scene {
 public:
  Scene(const LaserModel& laser, const BallPhysics& ball, std::uint64_t seed)
      : ball_(ball), builder_(laser, ball.radius_m, kicking::Draws{seed, 0}) {}

  /// Lets `duration_ns` pass; the ball, if there is one, moves by advance().
  void pass(std::int64_t duration_ns) {
    for (const std::int64_t end_ns = t_ns_ + duration_ns; t_ns_ < end_ns;) {
      const std::int64_t step_ns = std::min(kStep_ns, end_ns - t_ns_);
      if (motion) sim::advance(*motion, ball_, kicking::seconds(step_ns));
      t_ns_ += step_ns;
      builder_.advance(t_ns_, motion ? std::optional(motion->position_m) : std::nullopt);
      while (auto scan = builder_.take()) scans.push_back(std::move(*scan));
    }
  }

  void drag_coefficient(double value) { ball_.drag_coefficient = value; }
  std::int64_t t_ns() const { return t_ns_; }

  std::optional<BallMotion> motion;
  std::vector<kicking::lob::Scan> scans;

 private:
  BallPhysics ball_;
  ScanBuilder builder_;
  std::int64_t t_ns_ = 0;
};

}  // namespace

SyntheticRecord synthesize_record(const LaserModel& laser, const RecordPlan& plan, const BallPhysics& ball,
                                  std::uint64_t seed) {
  const double heading = laser.heading_rad + plan.direction_error_rad;
  const Eigen::Vector3d launch{-plan.lateral_error_m * std::cos(laser.heading_rad),
                               -plan.lateral_error_m * std::sin(laser.heading_rad), ball.radius_m};
  SyntheticRecord record{mount_of(laser, Eigen::Vector3d::Zero()), {}, {}};
  Scene scene{laser, ball, seed};
  scene.pass(kicking::nanoseconds(plan.background_s));
  for (std::uint32_t i = 0; i < plan.kicks.size(); ++i) {
    const SyntheticKick& kick = plan.kicks[i];
    scene.motion = BallMotion{{launch}, true};
    // A kick falls anywhere within a revolution.
    scene.pass(kicking::nanoseconds(
        plan.lie_s + kicking::Draws{seed, i}.uniform_in(0.0, laser.geometry.scan_period_s, kicking::Role::kStart, 0)));
    record.truth.push_back({scene.t_ns(), kick});
    const double v_h = kick.exit_speed_mps * std::cos(kick.exit_angle_rad);
    scene.drag_coefficient(kick.drag_coefficient);
    scene.motion = BallMotion{
        {launch,
         {-v_h * std::sin(heading), v_h * std::cos(heading), kick.exit_speed_mps * std::sin(kick.exit_angle_rad)}}};
    scene.pass(kicking::nanoseconds(plan.fly_s));
    scene.motion.reset();
    scene.pass(kicking::nanoseconds(plan.pause_s));
  }
  record.scans = std::move(scene.scans);
  return record;
}

}  // namespace trivela::sim
