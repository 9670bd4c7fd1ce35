#include <benchmark/benchmark.h>

#include <array>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/ballistics/flight.hpp"
#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/outcome/outcome.hpp"
#include "kicking/policy/policy.hpp"

// Hot functions of a decision. `--benchmark_repetitions=9` prints the median.
namespace {

using namespace trivela::kicking;

/// Situations of a robot that turns through the target; the first cycle of each possession is aligned or not.
std::array<PolicyInput, 64> situations() {
  std::array<PolicyInput, 64> inputs;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double x = static_cast<double>(i) / 63.0;
    PolicyInput& input = inputs[i];
    input.t_ns = 20'000'000 * static_cast<std::int64_t>(i);
    input.pose = {2.0 * x - 1.0, 1.0 + 4.0 * x, 0.6 - 1.2 * x};
    input.twist = {0.8 * x - 0.4, 0.5 + x, 2.0 * x - 1.0};
    input.playing = input.possession = input.kicker_ready = true;
    input.possession_id = static_cast<std::uint32_t>(i);
  }
  return inputs;
}

void judge_cycles(benchmark::State& state, PolicyName policy, const PolicyConfig& config) {
  const auto inputs = situations();
  const RobotModel robot;
  const Goal goal;
  PolicyMemory memory;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(evaluate(policy, config, robot, goal, inputs[i++ % inputs.size()], memory));
  }
}

void moving_kick_decision(benchmark::State& state, HeightLaw height, MotionLaw motion, AlphaLaw alpha) {
  PolicyConfig config;
  config.height_law = height;
  config.motion_law = motion;
  config.alpha_law = alpha;
  judge_cycles(state, PolicyName::kMoving, config);
}
BENCHMARK_CAPTURE(moving_kick_decision, paper, HeightLaw::kPaper, MotionLaw::kPaper, AlphaLaw::kPaperLine);
BENCHMARK_CAPTURE(moving_kick_decision, released_code, HeightLaw::kExtendedRange, MotionLaw::kPaper,
                  AlphaLaw::kPaperLine);
BENCHMARK_CAPTURE(moving_kick_decision, exact, HeightLaw::kExact, MotionLaw::kExact, AlphaLaw::kPaperLine);
BENCHMARK_CAPTURE(moving_kick_decision, physical, HeightLaw::kExact, MotionLaw::kExact, AlphaLaw::kPhysical);

void stopped_kick_decision(benchmark::State& state) { judge_cycles(state, PolicyName::kStopped, {}); }
BENCHMARK(stopped_kick_decision);

/// Opponents from near to far, watched for a while: what a cycle of play looks like. 1: past a keeper; 2: and with a
/// lever for flat kicks, and opponents with a place; 3: the same by the policy learned.
void predictive_kick_decision(benchmark::State& state) {
  auto inputs = situations();
  if (state.range(0) != 0)
    for (PolicyInput& input : inputs) input.keeper = KeeperPlace{0.1, 0.1};
  std::array<PolicyMemory, 64> watched;
  PolicyConfig config;
  RobotModel robot;
  const PolicyName policy = state.range(0) == 3 ? PolicyName::kLearned : PolicyName::kPredictive;
  if (policy == PolicyName::kLearned) {
    LearnedDecision& decision = config.learned.emplace().decision;
    decision.fire_weights.fill(0.01);
    decision.blocking_ratio = 0.7;
    decision.style[0] = {.speed_ratio = 1.2, .side_ratio = 2.5};
  }
  if (state.range(0) >= 2) {
    config.predictive.opponent_places = true;
    robot.further_kinds.push_back(robot);
    robot.further_kinds.front().exit_angle_rad = radians(6.0);
    for (PolicyInput& input : inputs) {
      input.opponents[0] = {Eigen::Vector2d{input.pose.x_m + 0.5, input.pose.y_m + 1.0}, 1.3, 0.1};
      input.opponent_count = 1;
    }
  }
  const Goal goal;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (int cycle = 10; cycle > 0; --cycle) {
      PolicyInput before = inputs[i];
      before.t_ns -= std::int64_t{20'000'000} * cycle;
      before.opponent_distance_m = 0.8 + 0.3 * static_cast<double>(i % 8) + 0.026 * cycle;
      before.kicker_ready = false;
      evaluate(policy, config, robot, goal, before, watched[i]);
    }
    inputs[i].opponent_distance_m = 0.8 + 0.3 * static_cast<double>(i % 8);
  }
  std::size_t i = 0;
  for (auto _ : state) {
    PolicyMemory memory = watched[i];
    benchmark::DoNotOptimize(evaluate(policy, config, robot, goal, inputs[i], memory));
    i = (i + 1) % inputs.size();
  }
}
BENCHMARK(predictive_kick_decision)->ArgName("keeper")->Arg(0)->Arg(1)->Arg(2)->Arg(3);

void solve_moving_kick(benchmark::State& state) {
  FlightPoint point{5.73, 0.59};
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(moving_kick_exact(point, radians(36.78), 1.0));
  }
}
BENCHMARK(solve_moving_kick);

void solve_with_drag(benchmark::State& state) {
  FlightPoint point{5.73, 0.59};
  for (auto _ : state) {
    benchmark::DoNotOptimize(point);
    benchmark::DoNotOptimize(crossing_speed_with_drag(point, radians(36.78), drag_per_m({}, {})));
  }
}
BENCHMARK(solve_with_drag);

void predict_release(benchmark::State& state) {
  Pose pose{1.0, 3.0, 0.1};
  for (auto _ : state) {
    benchmark::DoNotOptimize(pose);
    benchmark::DoNotOptimize(predict_crossing(pose, {0.4, 1.0, 0.8}, {8.0, radians(36.78), {}, 0.06, 0.27}, 9.0));
  }
}
BENCHMARK(predict_release);

void probability_inside(benchmark::State& state) {
  KickAtLine kick{8.0, radians(36.78), 1.0, 6.0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(kick);
    benchmark::DoNotOptimize(p_inside(kick, {0.02, 0.01, 0.05, 0.25}, 0.1, {}));
  }
}
BENCHMARK(probability_inside);

}  // namespace
