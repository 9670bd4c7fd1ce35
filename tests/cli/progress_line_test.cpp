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
  EXPECT_THAT(progress_line(1.0, 10.0, 60.0, "calibrations", ""),
              AllOf(HasSubstr("9 min left"), HasSubstr("0.017 calibrations/s")));
  EXPECT_THAT(progress_line(1.0, 100.0, 360.0, "", ""), HasSubstr("9.9 h left"));
}

TEST(ProgressLine, IsNoWiderThanTheTerminal) {
  for (std::size_t columns = 1; columns <= 120; ++columns) {
    const std::string line = progress_line(250.0, 1000.0, 5.0, "matches", "the factorial", columns);
    EXPECT_LE(line.size(), columns);
    EXPECT_EQ(line.find('[') != std::string::npos, columns >= 59) << "a bar of eight at least, or none: " << columns;
  }
  EXPECT_EQ(progress_line(250.0, 1000.0, 5.0, "matches", "the factorial", 60),
            "  [##       ]  25 %  15 s left  50 matches/s  the factorial");
}

TEST(CutTo, CountsCharactersAndNotBytes) {
  EXPECT_EQ(cut_to("3.5 \xe2\x80\x93 4.5", 5), "3.5 \xe2\x80\x93");
  EXPECT_EQ(cut_to("short", 80), "short");
  EXPECT_EQ(cut_to("", 3), "");
  EXPECT_EQ(lines_cut_to("one two\nthree\n\nfour", 4), "one \nthre\n\nfour");
}

TEST(ProgressLine, NeverSaysMoreThanAll) {
  EXPECT_THAT(progress_line(12.0, 10.0, 1.0, "", ""), AllOf(HasSubstr("100 %"), HasSubstr("0 s left")));
}

}  // namespace
}  // namespace trivela::cli
