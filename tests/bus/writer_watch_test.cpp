#include "bus/writer.hpp"

#include <gtest/gtest.h>

namespace trivela::bus {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(WriterWatch, OneThatTakesAnothersPlaceIsNoSecondOne) {
  WriterWatch watch;
  for (std::int64_t t_ns = 0; t_ns < 5; ++t_ns) EXPECT_FALSE(watch.see(1, t_ns));
  for (std::int64_t t_ns = 5; t_ns < 9; ++t_ns) EXPECT_FALSE(watch.see(2, t_ns));
  EXPECT_FALSE(watch.contested(9));
}

TEST(WriterWatch, OneThatComesBackIsToldOnceUntilASecondHasPassed) {
  WriterWatch watch;
  watch.see(1, 0);
  EXPECT_FALSE(watch.see(2, 10));
  EXPECT_TRUE(watch.see(1, 20));
  EXPECT_TRUE(watch.contested(20));
  EXPECT_FALSE(watch.see(2, 30)) << "that is known";
  EXPECT_TRUE(watch.contested(30 + kSecond_ns - 1));
  EXPECT_FALSE(watch.contested(30 + kSecond_ns));
  EXPECT_FALSE(watch.see(1, 30 + 2 * kSecond_ns)) << "the other was gone for two seconds: the robot's node came back";
}

}  // namespace
}  // namespace trivela::bus
