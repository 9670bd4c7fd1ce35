#include "log/write/scan_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace trivela::log {
namespace {

using Ranges = std::vector<std::uint32_t>;
using Bytes = std::vector<std::uint8_t>;
using testing::ElementsAre;

TEST(RangeCodec, WritesSmallDifferencesInOneByteAndLargeOnesInMore) {
  EXPECT_THAT(encode_ranges(Ranges{5, 4, 4}), ElementsAre(10, 1, 0));               // +5, -1, 0
  EXPECT_THAT(encode_ranges(Ranges{63, 127, 63}), ElementsAre(126, 0x80, 1, 127));  // +63, +64, -64
  EXPECT_TRUE(encode_ranges(Ranges{}).empty());
}

TEST(RangeCodec, GivesBackEveryValue) {
  for (const Ranges& ranges :
       {Ranges{}, Ranges{0}, Ranges{0xFFFFFFFF}, Ranges{0, 0xFFFFFFFF, 0, 0x80000000, 0x7FFFFFFF},
        Ranges{0x80000000, 0, 0x80000000}, Ranges{19, 0, 30000, 1, 262143}}) {
    EXPECT_EQ(decode_ranges(encode_ranges(ranges)), ranges);
  }
  std::mt19937 random(1);
  for (int bits = 1; bits <= 32; ++bits) {
    Ranges ranges(257);
    for (std::uint32_t& range : ranges) range = static_cast<std::uint32_t>(random()) >> (32 - bits);
    EXPECT_EQ(decode_ranges(encode_ranges(ranges)), ranges) << bits;
  }
}

TEST(RangeCodec, ARoomWithTenMillimetresOfNoiseTakesAtMostTwoBytesABeam) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise_mm(0.0, 10.0);
  Ranges ranges;
  for (int i = 0; i < 1081; ++i) {
    const double wall_mm = 6000.0 / std::max(0.2, std::abs(std::cos((i - 540) * 0.00436)));
    ranges.push_back(static_cast<std::uint32_t>(wall_mm + noise_mm(random)));
  }
  EXPECT_LE(encode_ranges(ranges).size(), 2 * ranges.size());
}

TEST(RangeCodec, RefusesBytesThatAreNoRanges) {
  EXPECT_EQ(decode_ranges(Bytes{0x80}), std::nullopt) << "ends inside a number";
  EXPECT_EQ(decode_ranges(Bytes{0xFF, 0xFF, 0xFF, 0xFF, 0x1F}), std::nullopt) << "33 bits";
  EXPECT_EQ(decode_ranges(Bytes{0x80, 0x80, 0x80, 0x80, 0x80, 0x00}), std::nullopt) << "six bytes";
  EXPECT_EQ(decode_ranges(Bytes{0xFF, 0xFF, 0xFF, 0xFF, 0x0F}), Ranges{0x80000000});
}

}  // namespace
}  // namespace trivela::log
