#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>

#include "kicking/outcome/outcome.hpp"
#include "tests/kicking/play.hpp"

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

namespace trivela::kicking {
namespace {

TEST(Allocation, IsCounted) {
  const std::size_t before = allocations;
  const auto text = std::make_unique<std::string>(100, 'x');
  EXPECT_GT(allocations, before);
}

void expect_decisions_without_allocation(const RobotModel& robot) {
  std::vector<PolicyMemory> memories;
  for (std::size_t place = 0; place < kPolicyCount; ++place) memories.emplace_back(static_cast<PolicyName>(place));
  PolicyConfig config;
  config.learned.emplace().decision.styles = kDriveStyles;
  double sum = 0.0;
  const std::size_t before = allocations;
  for (std::size_t place = 0; place < kPolicyCount; ++place) {
    const auto policy = static_cast<PolicyName>(place);
    PolicyMemory& memory = memories[place];
    for (const HeightLaw height : {HeightLaw::kPaper, HeightLaw::kExtendedRange, HeightLaw::kExact}) {
      for (const MotionLaw motion : {MotionLaw::kPaper, MotionLaw::kExact}) {
        for (const AlphaLaw alpha : {AlphaLaw::kPaperLine, AlphaLaw::kPhysical}) {
          config.height_law = height;
          config.motion_law = motion;
          config.alpha_law = alpha;
          for (int i = 0; i < 50; ++i) {
            PolicyInput input = tests::ready_at({0.5, 3, 0.05 * i - 1.0}, {0.2, 1.0, 0.5});
            input.t_ns = 20'000'000 * i;
            input.opponent_distance_m = 2.0 - 0.02 * i;
            input.possession_id = static_cast<std::uint32_t>(i / 10);
            input.last_kick = SeenKick{i, input.possession_id - 1, 0.1};
            const PolicyOutput output = evaluate(policy, config, robot, {}, input, memory);
            sum += output.distance_m + p_inside({8, 0.6, 1, 6}, {0.02, 0.01, 0.05, 0.25}, 0, {}).p_inside;
          }
        }
      }
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(sum, 0.0);
}

TEST(Allocation, ThereIsNoneInADecision) { expect_decisions_without_allocation({}); }

TEST(Allocation, ThereIsNoneWithAnExitAngleForEachPower) {
  RobotModel robot;
  const AnglePoint angles[] = {{15, 0.8}, {50, 0.6}};
  robot.exit_angles.emplace(angles);
  expect_decisions_without_allocation(robot);
}

}  // namespace
}  // namespace trivela::kicking
