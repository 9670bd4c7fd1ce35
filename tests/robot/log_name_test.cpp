#include "robot/recording/log_family.hpp"

#include <gtest/gtest.h>

namespace trivela::robot {
namespace {

const LogNaming kNaming{"cambada", 3, 1'764'000'000'000'000'000};

TEST(LogName, AFilesOwnNameStays) { EXPECT_EQ(log_path("out/match.db", kNaming), "out/match.db"); }

TEST(LogName, AFolderGetsTeamRobotAndTime) {
  EXPECT_EQ(log_path("out/", kNaming), "out/cambada-3-20251124T160000Z.db");
  EXPECT_EQ(log_path(TRIVELA_SOURCE_DIR, kNaming).parent_path(), TRIVELA_SOURCE_DIR);
  EXPECT_EQ(log_path("", kNaming), "cambada-3-20251124T160000Z.db");
}

TEST(LogName, APatternIsFilledInAndItsFolderIsNot) {
  EXPECT_EQ(log_path("{team}/final-{robot}.db", kNaming), "{team}/final-3.db");
  EXPECT_EQ(log_path("{team}-{team}.db", {"a/b", 3, 0}), "a_b-a_b.db");
}

TEST(LogName, AFamilyIsWhatTheSameSettingMade) {
  const LogFamily dated = log_family("out/", kNaming);
  EXPECT_TRUE(dated.has("cambada-3-20251124T150000Z-2.db"));
  EXPECT_FALSE(dated.has("cambada-4-20251124T150000Z.db"));
  EXPECT_FALSE(dated.has("cambada-3-20251124T150000Z.txt"));
  const LogFamily named = log_family("match.db", kNaming);
  EXPECT_TRUE(named.has("match.db"));
  EXPECT_TRUE(named.has("match-r3-20251124T150000Z.db"));
  EXPECT_FALSE(named.has("matches.db"));
}

}  // namespace
}  // namespace trivela::robot
