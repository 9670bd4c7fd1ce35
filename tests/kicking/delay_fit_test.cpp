#include "kicking/fit/scatter_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace trivela::kicking {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST(DelayFit, IsMeanAndSpreadOfTheReadings) {
  const DelayFit fit = fit_delay(std::vector{0.05, 0.06, 0.07, 0.06});
  EXPECT_NEAR(fit.mean_s.value, 0.06, 1e-15);
  EXPECT_NEAR(fit.sd_s, 0.01 * std::sqrt(2.0 / 3.0), 1e-15);
  EXPECT_NEAR(fit.mean_s.se, fit.sd_s / 2.0, 1e-15);
  EXPECT_NEAR(fit.median_s, 0.06, 1e-15);
  EXPECT_NEAR(fit.residual_s[2], 0.01, 1e-15);
  EXPECT_THAT(fit.rejected, IsEmpty());
}

TEST(DelayFit, LeavesOutliersOutAndNamesThem) {
  const DelayFit fit = fit_delay(std::vector{0.061, 0.5, 0.059, 0.060, 0.062, -0.2, 0.058});
  EXPECT_THAT(fit.rejected, ElementsAre(1, 5));
  EXPECT_NEAR(fit.mean_s.value, 0.06, 1e-15);
  EXPECT_NEAR(fit.residual_s[1], 0.44, 1e-12);
}

TEST(DelayFit, RejectsByTheSpreadThatIsThere) {
  // median 0.06, MAD 0.02: the limit is 3.5 * 1.4826 * 0.02 = 0.1038.
  EXPECT_THAT(fit_delay(std::vector{0.02, 0.04, 0.06, 0.08, 0.163}).rejected, IsEmpty());
  EXPECT_THAT(fit_delay(std::vector{0.02, 0.04, 0.06, 0.08, 0.164}).rejected, ElementsAre(4));
}

TEST(DelayFit, AReadingOneCycleOffIsNoOutlierAmongEqualOnes) {
  EXPECT_THAT(fit_delay(std::vector{0.06, 0.06, 0.06, 0.06, 0.08}).rejected, IsEmpty());
  EXPECT_THAT(fit_delay(std::vector{0.06, 0.06, 0.06, 0.06, 0.10}).rejected, ElementsAre(4));
}

TEST(DelayFit, RefusesWhatSaysNothing) {
  const auto fit = [](std::vector<double> delays) { return [delays] { fit_delay(delays); }; };
  EXPECT_THAT(fit({}), ThrowsMessage<std::invalid_argument>("delay: 0 readings, need at least 2"));
  EXPECT_THAT(fit({0.06}), ThrowsMessage<std::invalid_argument>("delay: 1 reading, need at least 2"));
  EXPECT_THAT(fit({0.06, std::numeric_limits<double>::infinity()}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("reading 2 is not finite")));
}

}  // namespace
}  // namespace trivela::kicking
