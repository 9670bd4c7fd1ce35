#include "config/text/parse_number.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trivela::config {
namespace {

TEST(ParseNumber, TakesWhatFlagsMayHold) {
  const auto expect = [](const char* text, double value) {
    const auto number = parse_number(text);
    ASSERT_TRUE(number) << text;
    EXPECT_EQ(*number, value) << text;
    EXPECT_EQ(std::signbit(*number), std::signbit(value)) << text;
  };
  expect("1", 1.0);
  expect(" 1", 1.0);
  expect("\t-1", -1.0);
  expect("+1", 1.0);
  expect("-0", -0.0);
  expect("1e5", 1e5);
  expect("1E-5", 1e-5);
  expect("0.1", 0.1);
  expect("1.", 1.0);
  expect(".5", 0.5);
  expect("0x10", 16.0);
  expect("-0X.8p1", -1.0);
  expect("inf", INFINITY);
  expect("-Infinity", -INFINITY);
  expect("1e400", INFINITY);
  expect("-1e9999", -INFINITY);
  expect("1e-9999", 0.0);
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_TRUE(std::isnan(parse_number("-NAN").value()));
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const char* text : {"", " ", "1 ", "1,5", "1e", "e5", ".", "+", "+-1", "--1", "- 1", "0x", "0x-1", "1x", "x"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(ParseDecimal, TakesNoBlanksAndNothingHexadecimal) {
  EXPECT_EQ(parse_decimal("+1.5e1"), 15.0);
  EXPECT_EQ(parse_decimal(".5"), 0.5);
  EXPECT_EQ(parse_decimal("1."), 1.0);
  EXPECT_TRUE(std::isnan(parse_decimal("nan").value()));
  for (const char* text : {"", " 1", "1 ", "0x10", "1e400", "++1"}) EXPECT_FALSE(parse_decimal(text)) << text;
}

TEST(ParseInteger, TakesDecimalHexadecimalAndOctal) {
  EXPECT_EQ(parse_integer("8080"), 8080);
  EXPECT_EQ(parse_integer(" +7"), 7);
  EXPECT_EQ(parse_integer("-1"), -1);
  EXPECT_EQ(parse_integer("0x10"), 16);
  EXPECT_EQ(parse_integer("010"), 8);
  EXPECT_EQ(parse_integer("0"), 0);
  for (const char* text : {"", "1 ", "1e5", "1.", "nan", "0x", "08", "--1", "9223372036854775808"})
    EXPECT_FALSE(parse_integer(text)) << text;
}

}  // namespace
}  // namespace trivela::config
