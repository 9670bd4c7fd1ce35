#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "kicking/outcome/opponents.hpp"
#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/shot_chance.hpp"
#include "sim/robot_body.hpp"
#include "sim/scenario.hpp"
#include "sim/truth.hpp"

namespace trivela::bench {

inline constexpr std::size_t kSegment = 6;  // cycles of one command
inline constexpr double kLongest_s = 4.0;   // of a plan
inline constexpr std::size_t kElite = 8;    // plans that the next ones are drawn about
inline constexpr double kStop_per_min = 60.0;

/// Commands of each cycle, and the best shot on their way.
struct Plan {
  std::vector<kicking::Twist> commands;
  double value = 0.0;  ///< probability that it scores, and that the referee has not stopped the game before
  double fire_after_s = 0.0;
  double power = 0.0;
  std::uint8_t kind = 0;
};

/// What a plan is worth from one state of the world.
class Worth {
 public:
  Worth(const sim::Scenario& scenario, const kicking::PolicyConfig& config, const kicking::RobotModel& robot,
        const kicking::Goal& goal, const sim::TrueState& state, double dispute_s)
      : scenario_(scenario), robot_(robot), goal_(goal), state_(state), last_fire_s_(dispute_s) {
    std::optional<kicking::KeeperPlace> keeper;
    if (state.keeper_x_m && config.objective == kicking::Objective::kGoal)
      keeper = kicking::KeeperPlace{*state.keeper_x_m, 0.0};
    past_keeper_ = keeper.has_value();
    for (std::size_t i = 0; i < robot.kinds(); ++i) {
      models_.emplace_back(config, robot.kind(i), goal, kicking::StateSpread{}, keeper);
      const auto& table = robot.kind(i).table;
      guesses_.push_back({.exit_angle = kicking::Elevation(
                              robot.kind(i).exit_angle_at(0.5 * (table.front().power + table.back().power)))});
    }
  }

  std::size_t cycles() const {
    return static_cast<std::size_t>(std::min(last_fire_s_ + 0.1, kLongest_s) / scenario_.cycle_s) + 1;
  }

  /// Drives the plan and finds its best shot. A ball that leaves the field ends it.
  void judge(Plan& plan) {
    plan.value = 0.0;
    sim::RobotBody body{scenario_.robot};
    body.place(state_.pose, state_.twist);
    for (std::size_t i = 0; i < plan.commands.size(); ++i) {
      body.follow(plan.commands[i]);
      body.advance(scenario_.cycle_s);
      const Eigen::Vector3d ball = body.ball_point_m();
      if (std::abs(ball.x()) > scenario_.field.side_line_x_m || std::abs(ball.y()) > scenario_.field.goal_line_y_m)
        return;
      look(body, scenario_.cycle_s * static_cast<double>(i + 1), plan);
    }
  }

  const kicking::Goal& goal() const { return goal_; }

 private:
  void look(const sim::RobotBody& body, double release_s, Plan& plan) {
    const kicking::Twist twist = body.twist();
    const Eigen::Vector2d forward{-body.axis().s, body.axis().c}, right{body.axis().c, body.axis().s};
    const kicking::ReleaseState release{body.ball_point_m().head<2>(), forward,
                                        twist.vx_mps * right + twist.vy_mps * forward, twist.omega_radps};
    for (std::size_t kind = 0; kind < models_.size(); ++kind) {
      const double fire_s = release_s - robot_.kind(kind).delay_s;
      const double stands_s = state_.lever_kind == kind ? 0.0 : robot_.lever_s + scenario_.cycle_s;
      if (fire_s < stands_s || fire_s > last_fire_s_) continue;
      const kicking::ShotChance shot = models_[kind].chance(release, guesses_[kind]);
      const double p = past_keeper_ ? shot.p_goal : shot.p;
      const double kept = std::exp(-scenario_.referee.stops_per_min / kStop_per_min * fire_s);
      if (p * kept <= plan.value) continue;
      const double value = p * kept * passes(release, shot, kind, release_s);
      if (value <= plan.value) continue;
      plan.value = value;
      plan.fire_after_s = fire_s;
      plan.power = shot.power;
      plan.kind = static_cast<std::uint8_t>(kind);
    }
  }

  /// Probability that no opponent is in the way: each keeps its bearing from the ball and comes nearer.
  double passes(const kicking::ReleaseState& release, const kicking::ShotChance& shot, std::size_t kind,
                double release_s) const {
    const Eigen::Vector2d held = {state_.pose.x_m - robot_.ball_offset_m * std::sin(state_.pose.heading_rad),
                                  state_.pose.y_m + robot_.ball_offset_m * std::cos(state_.pose.heading_rad)};
    const double way_m = std::hypot(shot.crossing.x_m - release.ball_m.x(), goal_.y_m - release.ball_m.y());
    const kicking::KickPath path{
        .velocity_mps = shot.exit.v_kick_mps * shot.exit.exit_angle.cosine * release.forward +
                        release.carried_mps(robot_.kind(kind).transfer_exact, robot_.ball_offset_m),
        .v_z_mps = shot.exit.v_kick_mps * shot.exit.exit_angle.sine,
        .sd_rad = shot.crossing.sd_x_m / std::max(0.1, way_m)};
    const kicking::Body body{scenario_.opponent.body_radius_m, scenario_.opponent.body_height_m};
    double p = 1.0;
    for (std::size_t i = 0; i < state_.opponent_count; ++i) {
      const Eigen::Vector2d apart = state_.opponents[i].position_m - held;
      const double then_m = std::max(0.05, apart.norm() - state_.opponents[i].closing_mps * release_s);
      p *= 1.0 - kicking::p_in_the_way(then_m * apart.normalized(), 0.0, path, body, robot_.ball);
    }
    return p;
  }

  const sim::Scenario& scenario_;
  const kicking::RobotModel& robot_;
  const kicking::Goal& goal_;
  const sim::TrueState& state_;
  double last_fire_s_;
  bool past_keeper_ = false;
  std::vector<kicking::ShotModel> models_;
  std::vector<kicking::ShotGuess> guesses_;
};

/// The policy's own ways of driving, to both corners and the middle, at several speeds.
inline std::vector<Plan> plans_of_the_policy(const sim::TrueState& state, const kicking::PolicyConfig& config,
                                             const kicking::Goal& goal, std::size_t cycles) {
  std::vector<Plan> plans;
  for (const kicking::DrivePlan plan : kicking::kDrivePlans) {
    for (const double aim_x_m : {-0.74, -0.4, 0.0, 0.4, 0.74}) {
      for (const double speed_mps : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        kicking::DriveMotion base{state.pose, state.twist};
        Plan& next = plans.emplace_back();
        for (std::size_t i = 0; i < cycles; ++i) {
          next.commands.push_back(kicking::command_of(plan, base, config, {aim_x_m, goal.y_m}, speed_mps, 1.0, 8.0));
          base.step(next.commands.back(), config, config.cycle_s);
        }
      }
    }
  }
  return plans;
}

using Axes = std::array<double, 3>;  // sideways, forward, turning

inline bool is_better(const Plan& a, const Plan& b) { return a.value > b.value; }

/// Cross-entropy search: `samples` plans about the best ones, `rounds` times, from the best of the policy's own, from
/// two others of them and from nothing.
class Search {
 public:
  /// `sideways_mps`: no faster sideways than this.
  Search(Worth& worth, const sim::Scenario& scenario, double sideways_mps, int samples, int rounds,
         std::mt19937_64& random)
      : worth_(worth),
        limits_{std::min(sideways_mps, scenario.robot.max_speed_mps), scenario.robot.max_speed_mps,
                scenario.robot.max_turn_rate_radps},
        samples_(static_cast<std::size_t>(samples)),
        rounds_(rounds),
        random_(random),
        cycles_(worth.cycles()),
        mean_(cycles_ / kSegment + 1),
        sd_(mean_.size()) {}

  /// `known`: judged, the best first.
  Plan best(const std::vector<Plan>& known) {
    Plan best = known.front();
    for (std::size_t start = 0; start < 4; ++start) {
      begin(start < 3 ? &known[7 * start] : nullptr);
      for (int round = 0; round < rounds_; ++round) {
        Plan found = draw_and_learn();
        if (found.value > best.value) best = std::move(found);
      }
    }
    return best;
  }

 private:
  struct Drawn {
    Plan plan;
    std::vector<Axes> values;
  };

  void begin(const Plan* from) {
    for (std::size_t s = 0; s < mean_.size(); ++s) {
      for (std::size_t axis = 0; axis < 3; ++axis) sd_[s][axis] = (from == nullptr ? 0.8 : 0.35) * limits_[axis];
      const kicking::Twist at =
          from == nullptr ? kicking::Twist{} : from->commands[std::min(s * kSegment, cycles_ - 1)];
      mean_[s] = {at.vx_mps, at.vy_mps, at.omega_radps};
    }
  }

  Drawn draw() {
    Drawn drawn{.plan = {}, .values = mean_};
    for (std::size_t s = 0; s < mean_.size(); ++s)
      for (std::size_t axis = 0; axis < 3; ++axis)
        drawn.values[s][axis] =
            std::clamp(std::normal_distribution{mean_[s][axis], sd_[s][axis]}(random_), -limits_[axis], limits_[axis]);
    for (std::size_t i = 0; i < cycles_; ++i) {
      const Axes& at = drawn.values[i / kSegment];
      drawn.plan.commands.push_back({at[0], at[1], at[2]});
    }
    worth_.judge(drawn.plan);
    return drawn;
  }

  Plan draw_and_learn() {
    std::vector<Drawn> all;
    all.reserve(samples_);
    for (std::size_t i = 0; i < samples_; ++i) all.push_back(draw());
    std::ranges::sort(all, is_better, &Drawn::plan);
    for (std::size_t s = 0; s < mean_.size(); ++s) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = 0.0, squares = 0.0;
        for (std::size_t e = 0; e < kElite; ++e) sum += all[e].values[s][axis];
        mean_[s][axis] = sum / kElite;
        for (std::size_t e = 0; e < kElite; ++e) squares += std::pow(all[e].values[s][axis] - mean_[s][axis], 2);
        sd_[s][axis] = std::sqrt(squares / kElite) + 0.02 * limits_[axis];
      }
    }
    return std::move(all.front().plan);
  }

  Worth& worth_;
  Axes limits_;
  std::size_t samples_;
  int rounds_;
  std::mt19937_64& random_;
  std::size_t cycles_;
  std::vector<Axes> mean_, sd_;
};

}  // namespace trivela::bench
