#include <gmock/gmock.h>

#include "cli/launch/progress_bar.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(ProgressLine, SaysShareTimeLeftAndRate) {
  EXPECT_EQ(progress_line(250.0, 1000.0, 5.0, "matches", "the factorial"),
            "  [##########                              ]  25 %  15 s left  50 matches/s  the factorial");
}

TEST(ProgressLine, HasNoTimeLeftBeforeAnythingIsDone) {
  EXPECT_THAT(progress_line(0.0, 10.0, 3.0, "fits", ""), AllOf(HasSubstr("begins"), Not(HasSubstr("left"))));
}

TEST(ProgressLine, HasNoShareWhereNobodyKnowsHowMuchThereIs) {
  const std::string line = progress_line(30000.0, 0.0, 2.0, "rows", "copied");
  EXPECT_THAT(line, AllOf(HasSubstr("30000 rows"), HasSubstr("15000 rows/s"), Not(HasSubstr("%"))));
}

TEST(ProgressLine, CountsSlowThingsByTheMinuteAndTheHour) {
  EXPECT_THAT(progress_line(1.0, 10.0, 60.0, "evenings", ""),
              AllOf(HasSubstr("9 min left"), HasSubstr("0.017 evenings/s")));
  EXPECT_THAT(progress_line(1.0, 100.0, 360.0, "", ""), HasSubstr("9.9 h left"));
}

TEST(ProgressLine, NeverSaysMoreThanAll) {
  EXPECT_THAT(progress_line(12.0, 10.0, 1.0, "", ""), AllOf(HasSubstr("100 %"), HasSubstr("0 s left")));
}

}  // namespace
}  // namespace trivela::cli
