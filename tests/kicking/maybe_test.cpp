#include "kicking/maybe.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace trivela::kicking {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNumbers[] = {0.0, -0.0, 0.4, -7.5, 5e-324, 1.7976931348623157e308, -1.7976931348623157e308};

static_assert(sizeof(Maybe) == sizeof(double));
template <class A, class B>
concept Compared = requires(A a, B b) {
  a == b;
};

static_assert(Compared<Maybe, double> && Compared<Maybe, std::nullopt_t>);
static_assert(!Compared<Maybe, std::optional<double>> && !Compared<std::optional<double>, Maybe>);
static_assert(!Maybe{} && !Maybe{std::nullopt} && Maybe{0.0});

TEST(Maybe, GivesANumberToTheNextMessageBitByBit) {
  for (const double number : kNumbers) {
    const Maybe maybe = number;
    ASSERT_TRUE(maybe) << number;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(maybe.wire()), std::bit_cast<std::uint64_t>(number)) << number;
    EXPECT_EQ(*maybe, number);
    EXPECT_EQ(maybe.value(), number);
    EXPECT_EQ(maybe.value_or(1.0), number);
  }
}

TEST(Maybe, TakesWhatIsNotFiniteForNone) {
  for (const double wire : {kNaN, -kNaN, kInfinity, -kInfinity}) {
    const Maybe maybe = wire;
    EXPECT_FALSE(maybe) << wire;
    EXPECT_TRUE(std::isnan(maybe.wire())) << wire;
    EXPECT_EQ(maybe.value_or(1.0), 1.0) << wire;
    EXPECT_THROW(static_cast<void>(maybe.value()), std::bad_optional_access) << wire;
  }
}

TEST(Maybe, BecomesAnOptionalAndComesBack) {
  for (const double number : kNumbers) {
    const std::optional<double> cell = Maybe{number};
    ASSERT_TRUE(cell) << number;
    EXPECT_EQ(Maybe{cell}, Maybe{number});
  }
  const std::optional<double> cell = Maybe{kNaN};
  EXPECT_FALSE(cell);
  EXPECT_FALSE(Maybe{cell});
  EXPECT_FALSE(Maybe{std::optional{kInfinity}});
}

TEST(Maybe, IsEqualToWhatIsMissingTooOrHasTheSameNumber) {
  EXPECT_EQ(Maybe{}, Maybe{kInfinity});
  EXPECT_EQ(Maybe{0.0}, Maybe{-0.0});
  EXPECT_NE(Maybe{}, Maybe{0.0});
  EXPECT_NE(Maybe{0.4}, Maybe{0.5});
}

}  // namespace
}  // namespace trivela::kicking
