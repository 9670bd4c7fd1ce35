#include "robot/watch/instant_watch.hpp"

#include <gtest/gtest.h>

namespace trivela::robot {
namespace {

TEST(CycleWatch, ACycleIsCompleteWithTheLastOfItsStreamsInAnyOrder) {
  CycleWatch watch;
  const std::size_t a = watch.add(), b = watch.add(), c = watch.add();
  EXPECT_EQ(watch.see(c, 0), std::nullopt);
  EXPECT_EQ(watch.see(a, 0), std::nullopt);
  EXPECT_EQ(watch.see(b, 0), 0);
  EXPECT_EQ(watch.see(b, 20), std::nullopt);
  EXPECT_EQ(watch.see(a, 20), std::nullopt);
  EXPECT_EQ(watch.see(c, 20), 20);
}

TEST(CycleWatch, ACycleIsReportedOnce) {
  CycleWatch watch;
  const std::size_t only = watch.add();
  EXPECT_EQ(watch.see(only, 20), 20);
  EXPECT_EQ(watch.see(only, 20), std::nullopt);
  EXPECT_EQ(watch.see(only, 0), std::nullopt) << "late and old";
  EXPECT_EQ(watch.see(only, 40), 40);
}

TEST(CycleWatch, AStreamThatHasSaidNothingHoldsTheFirstCycle) {
  CycleWatch watch;
  const std::size_t received = watch.add(), silent = watch.add();
  EXPECT_EQ(watch.see(received, 0), std::nullopt);
  EXPECT_EQ(watch.see(received, 20), std::nullopt);
  EXPECT_EQ(watch.see(silent, 0), 0);
}

}  // namespace
}  // namespace trivela::robot
