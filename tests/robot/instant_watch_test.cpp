#include "robot/watch/instant_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

TEST(InstantWatch, DoubtsAnInstantFarFromItsPredecessorAndGoesOnAfterwards) {
  InstantWatch watch;
  EXPECT_TRUE(watch.believes(7, 1000 * kSecond_ns));
  for (const std::int64_t forged : {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
                                    std::int64_t{0}, 1100 * kSecond_ns}) {
    EXPECT_FALSE(watch.believes(7, forged)) << forged;
    EXPECT_TRUE(watch.believes(7, 1001 * kSecond_ns));
  }
  EXPECT_TRUE(watch.believes(7, 1061 * kSecond_ns)) << "a minute's silence is possible";
}

TEST(InstantWatch, BelievesAJumpOnceTheNextOneConfirmsIt) {
  InstantWatch watch;
  EXPECT_TRUE(watch.believes(7, 0));
  EXPECT_FALSE(watch.believes(7, 1000 * kSecond_ns));
  EXPECT_TRUE(watch.believes(7, 1001 * kSecond_ns));
  EXPECT_TRUE(watch.believes(7, 1002 * kSecond_ns));
}

TEST(InstantWatch, KeepsWritersApart) {
  InstantWatch watch;
  EXPECT_TRUE(watch.believes(7, 0));
  EXPECT_TRUE(watch.believes(8, 1000 * kSecond_ns));
  EXPECT_TRUE(watch.believes(7, kSecond_ns));
}

}  // namespace
}  // namespace trivela::robot
