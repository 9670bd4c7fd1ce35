#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "emulators/sim/sim_messages.hpp"
#include "experiment/play/in_process_robot.hpp"
#include "experiment/play/play_match.hpp"
#include "sim/match.hpp"

namespace {

std::size_t allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace trivela::experiment {
namespace {

TEST(InProcessAllocations, AreCounted) {
  const std::size_t before = allocations;
  const auto text = std::make_unique<std::string>(100, 'x');
  EXPECT_GT(allocations, before);
}

class InProcessAllocation : public testing::TestWithParam<bool> {};

TEST_P(InProcessAllocation, ARobotsCycleNeedsNone) {
  const bool lever = GetParam();
  for (const auto policy :
       {kicking::PolicyName::kStopped, kicking::PolicyName::kMoving, kicking::PolicyName::kPredictive}) {
    config::Settings settings;
    settings.kick_decision.policy_by_half = {policy};
    config::Robot robot;
    sim::Scenario world;
    if (lever) {
      robot.model.further_kinds.push_back(robot.model);
      robot.model.further_kinds.front().exit_angle_rad = kicking::radians(6.0);
      world.keeper.enabled = world.kicker.flat.enabled = true;
    }
    InProcessRobot chain{settings, robot, 1, 1, std::nullopt};
    sim::Match match{world, 1, 1, 1e6, 10};
    std::size_t inside = 0;
    int orders = 0;
    while (!match.done()) {
      const sim::Sensors sensors = match.sense();
      const msg::Referee referee = hal::referee_message(sensors.t_ns, sensors.referee);
      const std::size_t before = allocations;
      const robot::CycleDecision* decision = chain.cycle(sensors, referee, std::nullopt, nullptr);
      inside += allocations - before;
      ASSERT_NE(decision, nullptr);
      sim::Commands commands{.drive = decision->output.drive, .lever_kind = decision->output.lever_kind, .fire{}};
      if (const auto& receipt = chain.receipt(); receipt && receipt->accepted) {
        commands.fire = sim::Fire{receipt->fired_t_ns, receipt->kick_id, receipt->power};
        ++orders;
      }
      match.step(commands);
    }
    EXPECT_EQ(inside, 0u) << kicking::name(policy);
    EXPECT_GT(orders, 0) << kicking::name(policy);
  }
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutALever, InProcessAllocation, testing::Bool());

TEST(InProcessAllocations, AMatchNeedsAFewForEachPossessionAndNoneForItsCycles) {
  const auto needed = [](std::uint32_t possessions) {
    const std::size_t before = allocations;
    play_match({}, Arm{}, 1, 0, possessions);
    return allocations - before;
  };
  const std::size_t few = needed(10), many = needed(110);
  EXPECT_LT(many - few, 100u * 15u) << "a possession has some eighty cycles, and a flight a few hypotheses";
}

}  // namespace
}  // namespace trivela::experiment
