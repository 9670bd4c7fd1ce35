#include "hal/scip/reply.hpp"

#include <gtest/gtest.h>

#include "tests/vector_rows.hpp"

namespace trivela::hal::scip {
namespace {

TEST(ScipCodec, AgreesWithTheVectors) {
  int numbers = 0;
  int sums = 0;
  for (const auto& row : tests::rows("scip.csv")) {
    SCOPED_TRACE(row.where());
    if (row.text("kind") == "encode") {
      const auto value = static_cast<std::uint32_t>(row.number("value"));
      EXPECT_EQ(encode(value, static_cast<std::size_t>(row.number("chars"))), row.text("text"));
      EXPECT_EQ(decode(row.text("text")), value);
      ++numbers;
    } else {
      EXPECT_EQ(checksum(row.text("value")), row.text("text").front());
      ++sums;
    }
  }
  EXPECT_EQ(numbers, 22);
  EXPECT_EQ(sums, 11);
}

TEST(ScipCodec, EveryValueOfThreeCharactersComesBack) {
  for (std::uint32_t value = 0; value < 1U << 18U; ++value) ASSERT_EQ(decode(encode(value, 3)), value);
}

TEST(ScipCodec, ValuesOfTwoAndFourCharactersComeBack) {
  for (std::uint32_t value = 0; value < 1U << 12U; ++value) ASSERT_EQ(decode(encode(value, 2)), value);
  for (std::uint32_t value = 0; value < 1U << 24U; value += 251) ASSERT_EQ(decode(encode(value, 4)), value);
}

TEST(ScipCodec, BitsThatDoNotFitAreCutOff) {
  EXPECT_EQ(encode((1U << 18U) + 5, 3), encode(5, 3));
  EXPECT_EQ(encode((1U << 24U) + 5, 4), encode(5, 4));
}

TEST(ScipCodec, RefusesEveryOtherCharacter) {
  for (int byte = 0; byte < 256; ++byte) {
    const char character = static_cast<char>(byte);
    const bool coded = byte >= 0x30 && byte <= 0x6f;
    EXPECT_EQ(decode(std::string{'0', character, '0'}).has_value(), coded) << byte;
    EXPECT_EQ(decode_all(std::string{'0', '0', '0', character, '0', '0'}, 3).has_value(), coded) << byte;
  }
}

TEST(ScipCodec, RefusesOtherLengths) {
  EXPECT_FALSE(decode(""));
  EXPECT_FALSE(decode("000000"));
  EXPECT_FALSE(decode_all("0000", 3));
  EXPECT_FALSE(decode_all("000", 0));
  EXPECT_FALSE(decode_all("000000", 6));
  EXPECT_EQ(decode_all("", 3).value().size(), 0U);
}

TEST(ScipCodec, ASumIsOfTheCodingAndSeesEveryChangeOfOneByteBelow64) {
  const std::string text = "DMAX:5600";
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int change = 1; change < 64; ++change) {
      std::string other = text;
      other[i] = static_cast<char>(other[i] + change);
      const char sum = checksum(other);
      EXPECT_NE(sum, checksum(text));
      EXPECT_TRUE(sum >= kFirstCharacter && sum <= kLastCharacter);
    }
  }
}

}  // namespace
}  // namespace trivela::hal::scip
