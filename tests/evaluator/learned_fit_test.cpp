#include "evaluator/learning/learned_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <random>

#include "kicking/outcome/outcome.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Kicks whose ball is on target with `chance` of what the robot believes.
std::vector<PredictedKick> kicks_of(std::uint32_t matches, int a_match, unsigned seed,
                                    const std::function<double(const kicking::ShotFeatures&)>& chance) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<PredictedKick> kicks;
  for (std::uint32_t match = 0; match < matches; ++match) {
    for (int i = 0; i < a_match; ++i) {
      const kicking::ShotFeatures shot{.p_on_target = 0.3 + 0.65 * unit(engine),
                                       .distance_m = 3.0 + 6.0 * unit(engine),
                                       .vx_mps = 2.0 * unit(engine) - 1.0,
                                       .vy_mps = 2.0 * unit(engine) - 0.5,
                                       .omega_radps = 4.0 * unit(engine) - 2.0,
                                       .power = 15.0 + 30.0 * unit(engine),
                                       .opponent_distance_m = 0.5 + 3.0 * unit(engine)};
      kicks.push_back({match, shot, unit(engine) < chance(shot)});
    }
  }
  return kicks;
}

double believed(const kicking::ShotFeatures& shot) { return shot.p_on_target; }

/// Far kicks are worse than the physics says, and all are too sure.
double distorted(const kicking::ShotFeatures& shot) {
  return kicking::logistic(0.5 * kicking::held_logit(shot.p_on_target) - 0.4 * (shot.distance_m - 6.0) - 0.3);
}

TEST(LearnedFit, FindsTheCorrectionThatMadeTheKicks) {
  const auto fit = fit_learned_model(kicks_of(400, 40, 1, distorted));
  const auto& m = fit.model;
  EXPECT_NEAR(m.weights[0] / m.scales[0], -0.5, 0.1);  // of the logit: 0.5 - 1
  // The distance's square takes part of the slope: the slope in the middle is what counts.
  EXPECT_NEAR(m.weights[1] / m.scales[1] + 12.0 * m.weights[2] / m.scales[2], -0.4, 0.05);
  for (const std::size_t i : {3u, 4u, 5u, 6u, 7u, 8u}) EXPECT_NEAR(m.weights[i], 0.0, 0.1) << i;
}

TEST(LearnedFit, BeatsADistortedProbabilityOnMatchesThatItHasNotSeen) {
  const auto fit = fit_learned_model(kicks_of(60, 30, 2, distorted));
  EXPECT_TRUE(fit.held_out.better());
  EXPECT_LT(fit.held_out.learned, fit.held_out.predictive);
  EXPECT_EQ(fit.matches + fit.held_out.matches, 60);
  EXPECT_EQ(fit.held_out.matches, 18);
}

TEST(LearnedFit, DoesNotBeatACalibratedProbability) {
  int better = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    better += fit_learned_model(kicks_of(40, 25, seed, believed)).held_out.better() ? 1 : 0;
  }
  EXPECT_LE(better, 1);
}

TEST(LearnedFit, DecilesHoldEveryHeldOutKickAndRise) {
  const auto fit = fit_learned_model(kicks_of(60, 30, 3, distorted));
  ASSERT_EQ(fit.held_out.deciles.size(), 10u);
  std::int64_t kicks = 0;
  double before = 0.0;
  for (const Decile& decile : fit.held_out.deciles) {
    kicks += decile.kicks;
    EXPECT_GT(decile.learned, before);
    before = decile.learned;
  }
  EXPECT_EQ(kicks, fit.held_out.kicks);
}

TEST(LearnedFit, SaysWhatIsMissing) {
  EXPECT_THAT([] { fit_learned_model({}); }, ThrowsMessage<std::runtime_error>(HasSubstr("no kick with a predicted")));
  EXPECT_THAT([] { fit_learned_model(kicks_of(1, 500, 1, believed)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("1 match with predicted kicks, need 10")));
  EXPECT_THAT([] { fit_learned_model(kicks_of(20, 4, 1, believed)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("kicks to learn from")));
  EXPECT_THAT([] { fit_learned_model(kicks_of(20, 20, 1, [](const auto&) { return 1.0; })); },
              ThrowsMessage<std::runtime_error>(HasSubstr("the same outcome (on target)")));
  EXPECT_THAT([] { fit_learned_model(kicks_of(12, 20, 1, believed)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("held-out matches with kicks, need 5")));
}

TEST(LearnedFit, IsTheSameForTheSameSeed) {
  const auto kicks = kicks_of(40, 25, 4, distorted);
  EXPECT_EQ(fit_learned_model(kicks).model.weights, fit_learned_model(kicks).model.weights);
}

}  // namespace
}  // namespace trivela::evaluator
