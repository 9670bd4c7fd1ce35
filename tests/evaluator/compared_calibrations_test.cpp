#include <gmock/gmock.h>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "tests/evaluator/experiment_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::Not;

class ComparedCalibrationsTest : public LogTest {
 protected:
  PolicyComparison compared() const {
    std::string by;
    KickDataset dataset = read_log_kicks({path()}, {}, by);
    return compare_policies(std::move(dataset), by);
  }

  // Matches on several calibrations; what the newer arm hits depends on the calibration most.
  void write(std::uint32_t matches, std::int64_t calibrations) {
    TestExperiment experiment(path(), matches);
    for (std::uint32_t match = 0; match < matches; ++match) {
      experiment.begin();
      for (std::int64_t calibration = 1; calibration <= calibrations; ++calibration) {
        experiment.calibration = calibration;
        for (const std::uint32_t arm : {0U, 1U}) {
          experiment.session(match, 2 * static_cast<std::uint32_t>(calibration) + arm, arm == 0 ? "slow" : "quick",
                             {{1, "moving"}});
          experiment.played(1, 10.0);
          for (std::int64_t i = 1; i <= 10; ++i)
            experiment.possession(1, i, "moving", 1.0,
                                  i <= (arm == 0 ? 4 : 3 + calibration % 4 + match % 2) ? kIn : kOut);
        }
      }
      experiment.commit();
    }
    experiment.finish();
  }
};

TEST_F(ComparedCalibrationsTest, CrossedWithTheMatchesTheyWidenTheInterval) {
  write(8, 6);
  const auto result = compared();
  const PairResult& pair = result.pairs[0];
  ASSERT_TRUE(pair.pairs);
  EXPECT_EQ(pair.pairs->n(), 480);
  EXPECT_EQ(result.groups[0].matches, 8U);
  ASSERT_TRUE(pair.per_opportunity->clustered);
  EXPECT_EQ(pair.per_opportunity->clustered->calibrations, 6U);
  EXPECT_TRUE(pair.per_opportunity->clustered->by_calibration);
  EXPECT_LT(pair.per_opportunity->clustered->df, 9.0) << "six calibrations decide";
  EXPECT_EQ(pair.headline->method, "paired, clustered by match and calibration");
  EXPECT_THAT(to_text(result), HasSubstr("clustered by match and calibration: 8 and 8 matches, 6 calibrations"));
}

TEST_F(ComparedCalibrationsTest, SaysHowManyAreNeededOnceAndTakesRatesByMatch) {
  write(6, 1);
  const auto result = compared();
  EXPECT_TRUE(result.pairs[0].kick_rate->by_match);
  EXPECT_THAT(to_text(result), Not(HasSubstr("kicks needed")));
  EXPECT_THAT(to_json(result), Not(HasSubstr("needed_kicks")));
  EXPECT_THAT(to_text(result), HasSubstr("P(quick > slow)"));
}

}  // namespace
}  // namespace trivela::evaluator
