#include "kicking/optional_double.hpp"

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

static_assert(sizeof(OptionalDouble) == sizeof(double));
template <class A, class B>
concept Compared = requires(A a, B b) {
  a == b;
};

static_assert(Compared<OptionalDouble, double> && Compared<OptionalDouble, std::nullopt_t>);
static_assert(!Compared<OptionalDouble, std::optional<double>> && !Compared<std::optional<double>, OptionalDouble>);
static_assert(!OptionalDouble{} && !OptionalDouble{std::nullopt} && OptionalDouble{0.0});

TEST(OptionalDouble, GivesANumberToTheNextMessageBitByBit) {
  for (const double number : kNumbers) {
    const OptionalDouble maybe = number;
    ASSERT_TRUE(maybe) << number;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(maybe.to_message()), std::bit_cast<std::uint64_t>(number)) << number;
    EXPECT_EQ(*maybe, number);
    EXPECT_EQ(maybe.value(), number);
    EXPECT_EQ(maybe.value_or(1.0), number);
  }
}

TEST(OptionalDouble, TakesWhatIsNotFiniteForNone) {
  for (const double to_message : {kNaN, -kNaN, kInfinity, -kInfinity}) {
    const OptionalDouble maybe = to_message;
    EXPECT_FALSE(maybe) << to_message;
    EXPECT_TRUE(std::isnan(maybe.to_message())) << to_message;
    EXPECT_EQ(maybe.value_or(1.0), 1.0) << to_message;
    EXPECT_THROW(static_cast<void>(maybe.value()), std::bad_optional_access) << to_message;
  }
}

TEST(OptionalDouble, BecomesAnOptionalAndComesBack) {
  for (const double number : kNumbers) {
    const std::optional<double> cell = OptionalDouble{number};
    ASSERT_TRUE(cell) << number;
    EXPECT_EQ(OptionalDouble{cell}, OptionalDouble{number});
  }
  const std::optional<double> cell = OptionalDouble{kNaN};
  EXPECT_FALSE(cell);
  EXPECT_FALSE(OptionalDouble{cell});
  EXPECT_FALSE(OptionalDouble{std::optional{kInfinity}});
}

TEST(OptionalDouble, IsEqualToWhatIsMissingTooOrHasTheSameNumber) {
  EXPECT_EQ(OptionalDouble{}, OptionalDouble{kInfinity});
  EXPECT_EQ(OptionalDouble{0.0}, OptionalDouble{-0.0});
  EXPECT_NE(OptionalDouble{}, OptionalDouble{0.0});
  EXPECT_NE(OptionalDouble{0.4}, OptionalDouble{0.5});
}

}  // namespace
}  // namespace trivela::kicking
