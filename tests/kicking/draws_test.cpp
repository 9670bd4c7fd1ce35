#include "kicking/random/draws.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::kicking {
namespace {

using Words = std::array<std::uint32_t, 4>;

TEST(Philox, GivesTheKnownAnswersOfRandom123) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Draws, AreTheSameInWhateverOrderTheyAreAskedFor) {
  const Draws draws{7, 3};
  const double first = draws.normal(Role::kKicker, 0);
  for (std::uint32_t i = 0; i < 10; ++i) draws.uniform(Role::kOpponent, i);
  EXPECT_EQ(draws.normal(Role::kKicker, 0), first);
  EXPECT_EQ((Draws{7, 3}.normal(Role::kKicker, 0)), first);
}

TEST(Draws, DifferInSeedOpportunityRoleCounterAndIndex) {
  const double reference = Draws{7, 3}.uniform(Role::kKicker, 5, 1);
  EXPECT_NE((Draws{8, 3}.uniform(Role::kKicker, 5, 1)), reference);
  EXPECT_NE((Draws{7 + (std::uint64_t{1} << 32), 3}.uniform(Role::kKicker, 5, 1)), reference);
  EXPECT_NE((Draws{7, 4}.uniform(Role::kKicker, 5, 1)), reference);
  EXPECT_NE((Draws{7, 3}.uniform(Role::kStart, 5, 1)), reference);
  EXPECT_NE((Draws{7, 3}.uniform(Role::kKicker, 6, 1)), reference);
  EXPECT_NE((Draws{7, 3}.uniform(Role::kKicker, 5, 2)), reference);
}

TEST(Draws, HaveTheMomentsOfTheirDistributions) {
  constexpr int kCount = 20000;
  double uniform_sum = 0, uniform_squares = 0, normal_sum = 0, normal_squares = 0, product = 0, fourth = 0, lag = 0;
  const Draws draws{11, 1};
  double previous = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double u = draws.uniform(Role::kStart, i);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    uniform_sum += u;
    uniform_squares += u * u;
    const auto [a, b, c, d] = draws.normals(Role::kStart, i, 1);
    normal_sum += a;
    normal_squares += a * a;
    fourth += a * a * a * a;
    product += (a * b + c * d) / std::sqrt(2.0);
    lag += a * previous;
    previous = a;
  }
  const double sd = 1.0 / std::sqrt(kCount);  // of a mean of unit variance; bounds are four of them
  EXPECT_NEAR(uniform_sum / kCount, 0.5, 4 * sd * 0.2887);
  EXPECT_NEAR(uniform_squares / kCount, 1.0 / 3, 4 * sd * 0.2981);
  EXPECT_NEAR(normal_sum / kCount, 0.0, 4 * sd);
  EXPECT_NEAR(normal_squares / kCount, 1.0, 4 * sd * std::sqrt(2.0));
  EXPECT_NEAR(fourth / kCount, 3.0, 4 * sd * std::sqrt(96.0));
  EXPECT_NEAR(product / kCount, 0.0, 4 * sd);
  EXPECT_NEAR(lag / kCount, 0.0, 4 * sd);
}

TEST(Draws, NormalsFollowTheNormalDistributionIntoItsTails) {
  // Counts in bins against erf, all four lanes alike: chi-squared over the bins, and the far tail by its count.
  constexpr int kCount = 200000, kBins = 48;
  const Draws draws{12, 1};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    std::array<int, kBins> counts{};
    int beyond_3_5 = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const double z = draws.normals(Role::kStart, i)[lane];
      if (std::abs(z) > 3.5) ++beyond_3_5;
      const int bin = static_cast<int>(std::floor((z + 3.0) * kBins / 6.0));
      if (bin >= 0 && bin < kBins) ++counts[static_cast<std::size_t>(bin)];
    }
    double chi_squared = 0.0;
    for (int i = 0; i < kBins; ++i) {
      const auto below = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
      const double low = -3.0 + 6.0 * i / kBins;
      const double expected = kCount * (below(low + 6.0 / kBins) - below(low));
      chi_squared += std::pow(counts[static_cast<std::size_t>(i)] - expected, 2) / expected;
    }
    EXPECT_LT(chi_squared, 48 + 4 * std::sqrt(2 * 48.0)) << lane;
    EXPECT_NEAR(beyond_3_5, kCount * 4.6526e-4, 4 * std::sqrt(kCount * 4.6526e-4)) << lane;  // 93 of 200,000
  }
}

TEST(Draws, ANormalIsTheFirstOfFour) {
  const Draws draws{12, 1};
  for (std::uint32_t i = 0; i < 2000; ++i) {
    ASSERT_EQ(draws.normal(Role::kStart, i, 3), draws.normals(Role::kStart, i, 3)[0]);
  }
}

}  // namespace
}  // namespace trivela::kicking
