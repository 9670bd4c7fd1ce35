#include "kicking/estimate.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace trivela::kicking {
namespace {

TEST(Median, IsTheMiddleOfAnOddSample) {
  std::vector<double> values{5.0, 1.0, 3.0};
  EXPECT_EQ(median(values), 3.0);
  EXPECT_EQ(upper_median(std::span(values)), 3.0);
}

TEST(Median, OfAnEvenSampleIsTheMeanOfTheTwoInTheMiddle) {
  std::vector<double> values{4.0, 1.0, 8.0, 3.0};
  EXPECT_EQ(median(values), 3.5);
  EXPECT_EQ(upper_median(std::span(values)), 4.0);
}

TEST(Median, IsOfWholeNumbersAsWell) {
  std::vector<std::uint32_t> values{7, 7, 2};
  EXPECT_EQ(upper_median(std::span(values)), 7U);
}

}  // namespace
}  // namespace trivela::kicking
