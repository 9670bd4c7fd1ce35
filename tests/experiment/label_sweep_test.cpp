#include "tests/experiment/label_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evaluator/stats/counts/exact.hpp"

namespace trivela::experiment {
namespace {

using evaluator::stats::clopper_pearson;

constexpr double kAlmostCertain = 0.999;  // of the intervals: a good observer does not fail by chance

LabelCounts played(const GoalCamera& camera, std::uint32_t matches, std::uint64_t seed = 1) {
  LabelCounts counts;
  for (std::uint32_t match = 0; match < matches; ++match) add_match(camera, seed, match, 40, counts);
  return counts;
}

// A part of the table in docs/evaluation.md (tests/bench/label_sweep.cpp makes all of it).
TEST(LabelSweep, LabelsAreRightAndTheBoundsHoldWhateverTheCamera) {
  for (const GoalCamera& camera :
       {GoalCamera{0.02, 60.0, 0.2}, GoalCamera{0.03, 30.0, 0.0}, GoalCamera{0.05, 10.0, 0.0},
        GoalCamera{0.10, 50.0, 0.0}, GoalCamera{0.10, 30.0, 0.2}, GoalCamera{0.15, 50.0, 0.4},
        GoalCamera{0.15, 10.0, 0.2}}) {
    const LabelCounts counts = played(camera, 16);
    const std::string what = std::to_string(camera.sd_m) + " m, " + std::to_string(camera.frames_per_s) +
                             " a second, " + std::to_string(camera.dropout_ratio);
    ASSERT_GT(counts.given, 30) << what;
    EXPECT_GE(clopper_pearson({counts.right, counts.given}, kAlmostCertain).hi, 0.97)
        << what << ": " << counts.right << " of " << counts.given;
    EXPECT_GE(clopper_pearson({counts.covered, counts.matches}, kAlmostCertain).hi, 0.95)
        << what << ": " << counts.covered << " of " << counts.matches;
    EXPECT_LT(counts.given - counts.right, counts.doubt + 4.0 * std::sqrt(counts.doubt) + 2.0) << what;
  }
}

// The robot's file, the ball and the camera are not what the observer believes.
TEST(LabelSweep, LabelsAreRightAndTheBoundsHoldWhereBeliefsAreWrong) {
  for (const OtherWorld& world : kOtherWorlds) {
    LabelCounts counts;
    for (std::uint32_t match = 0; match < 16; ++match) add_match({}, 1, match, 40, counts, world);
    ASSERT_GT(counts.given, 100) << world.what;
    EXPECT_GE(clopper_pearson({counts.right, counts.given}, kAlmostCertain).hi, 0.97)
        << world.what << ": " << counts.right << " of " << counts.given;
    EXPECT_GE(clopper_pearson({counts.covered, counts.matches}, kAlmostCertain).hi, 0.95)
        << world.what << ": " << counts.covered << " of " << counts.matches;
    EXPECT_GE(clopper_pearson({counts.saves_right, counts.inside}, kAlmostCertain).hi, 0.97)
        << world.what << ": saves of " << counts.saves_right << " of " << counts.inside;
  }
}

TEST(LabelSweep, FewAreUnknownAtThreeCentimetresAndThirtyFrames) {
  for (const double dropout_ratio : {0.0, 0.2}) {
    const LabelCounts counts = played({0.03, 30.0, dropout_ratio}, 30);
    EXPECT_LE(clopper_pearson({counts.unknown(), counts.kicks}, kAlmostCertain).lo, 0.03)
        << counts.unknown() << " of " << counts.kicks;
    EXPECT_LE(counts.unknown(), 0.06 * counts.kicks) << dropout_ratio;
  }
}

// Once 90 balls on target of 10,336 were called bar or post, and none the other way round.
TEST(LabelSweep, ErrorsGoNeitherWay) {
  const LabelCounts counts = played({0.03, 50.0, 0.02}, 60);
  EXPECT_GT(counts.kicks, 800);
  EXPECT_LE(counts.too_bad, 2) << "of balls on target";
  EXPECT_LE(counts.too_good, 6);
}

TEST(LabelSweep, WithAWorseCameraBallsOnTargetAreNotBlocked) {
  const LabelCounts counts = played({0.10, 50.0, 0.02}, 20);
  const auto blocked = counts.confused.find({kicking::Outcome::kOnTarget, kicking::Outcome::kBlocked});
  EXPECT_LE(blocked == counts.confused.end() ? 0 : blocked->second, 2);
  EXPECT_LT(counts.unknown(), counts.kicks / 5);
}

}  // namespace
}  // namespace trivela::experiment
