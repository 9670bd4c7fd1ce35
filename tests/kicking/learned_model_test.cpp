#include "kicking/policy/learned_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kicking/outcome/outcome.hpp"

namespace trivela::kicking {
namespace {

ShotFeatures shot(double p) {
  return {.p_on_target = p,
          .distance_m = 5.0,
          .vx_mps = -1.0,
          .vy_mps = 0.5,
          .omega_radps = 2.0,
          .power = 25.0,
          .opponent_distance_m = {}};
}

TEST(LearnedModel, WithoutWeightsIsThePhysicalProbability) {
  for (double p = 0.01; p < 1.0; p += 0.07) EXPECT_NEAR(LearnedModel{}.p_on_target(shot(p)), p, 1e-12);
}

TEST(LearnedModel, AddsItsCorrectionsToTheLogit) {
  LearnedModel model{.intercept = 0.5};
  model.weights[1] = -0.8;  // distance_m
  model.means[1] = 3.0;
  model.scales[1] = 4.0;
  // logit(0.6) + 0.5 - 0.8 (5 - 3) / 4
  EXPECT_NEAR(model.p_on_target(shot(0.6)), logistic(std::log(1.5) + 0.5 - 0.4), 1e-12);
}

TEST(LearnedModel, LeftAndRightCountAlike) {
  LearnedModel model;
  model.weights.fill(0.3);
  ShotFeatures mirrored = shot(0.7);
  mirrored.vx_mps = -mirrored.vx_mps;
  mirrored.omega_radps = -mirrored.omega_radps;
  EXPECT_DOUBLE_EQ(model.p_on_target(shot(0.7)), model.p_on_target(mirrored));
}

TEST(LearnedModel, HoldsCertaintiesAndOpponentsThatNobodySees) {
  EXPECT_NEAR(LearnedModel{}.p_on_target(shot(1.0)), 1.0 - 1e-4, 1e-12);
  EXPECT_NEAR(LearnedModel{}.p_on_target(shot(0.0)), 1e-4, 1e-12);
  ShotFeatures far = shot(0.5);
  far.opponent_distance_m = 40.0;
  EXPECT_EQ(LearnedModel::row_of(far), LearnedModel::row_of(shot(0.5)));
}

TEST(LearnedModel, RisesWithThePhysicalProbability) {
  LearnedModel model;
  model.weights.fill(0.2);
  double before = 0.0;
  for (double p = 0.001; p < 1.0; p += 0.01) {
    const double now = model.p_on_target(shot(p));
    EXPECT_GT(now, before);
    before = now;
  }
}

}  // namespace
}  // namespace trivela::kicking
