#include "cli/launch/match_run.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <string_view>

namespace trivela::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Feeder {
  void says(std::string_view text) { ASSERT_EQ(write(pipe.write_end(), text.data(), text.size()), std::ssize(text)); }
  ProgressPipe pipe;
};

TEST(ProgressPipe, SettingsComeBeforeTheFirstLineOfProgress) {
  Feeder feeder;
  feeder.says("refbox.port=34567\nhal.ioboard.port=\"/tmp/trivela-io");
  EXPECT_FALSE(feeder.pipe.take());
  EXPECT_FALSE(feeder.pipe.begun());
  feeder.says("board-x/kicker\"\n0.00 36.00\nrefbox.port=1\n");
  EXPECT_FALSE(feeder.pipe.take());
  EXPECT_TRUE(feeder.pipe.begun());
  EXPECT_THAT(feeder.pipe.settings(),
              ElementsAre("refbox.port=34567", "hal.ioboard.port=\"/tmp/trivela-ioboard-x/kicker\""));
}

TEST(ProgressPipe, TheLastLineSaysThatAllWasPlayed) {
  Feeder feeder;
  feeder.says("1.50 36.00\n");
  EXPECT_FALSE(feeder.pipe.take());
  EXPECT_EQ(feeder.pipe.played_s(), 1.5);
  EXPECT_EQ(feeder.pipe.total_s(), 36.0);
  EXPECT_FALSE(feeder.pipe.whole());
  EXPECT_THAT(feeder.pipe.settings(), IsEmpty());
  feeder.says("36.10 36.00 end\n");
  feeder.pipe.close_write_end();
  EXPECT_TRUE(feeder.pipe.take()) << "the end of the stream";
  EXPECT_TRUE(feeder.pipe.whole());
}

}  // namespace
}  // namespace trivela::cli
