#include "nodes/simulator/referee_repeats.hpp"

#include <gtest/gtest.h>

#include "tests/instants.hpp"

namespace trivela::nodes {
namespace {

class RefereeRepeatsTest : public testing::Test {
 protected:
  bool due_at(std::int64_t ms) {
    word.t_ns = ms * kMs;
    return repeats.due(word);
  }

  RefereeRepeats repeats{80 * kMs};
  msg::Referee word{};
};

TEST_F(RefereeRepeatsTest, TheSameWordIsSaidAgainAfterAPeriod) {
  EXPECT_TRUE(due_at(0));
  for (std::int64_t ms = 10; ms < 80; ms += 10) EXPECT_FALSE(due_at(ms));
  EXPECT_TRUE(due_at(80));
  EXPECT_FALSE(due_at(90));
}

TEST_F(RefereeRepeatsTest, AChangeIsSaidAtOnceAndTheClockOfTheHalfIsNone) {
  EXPECT_TRUE(due_at(0));
  word.half_time_s = 0.01;
  EXPECT_FALSE(due_at(10));
  word.playing = true;
  EXPECT_TRUE(due_at(20));
  word.possession_id = 2;
  EXPECT_TRUE(due_at(30));
  EXPECT_FALSE(due_at(100)) << "the period counts from the last word";
  EXPECT_TRUE(due_at(110));
}

}  // namespace
}  // namespace trivela::nodes
