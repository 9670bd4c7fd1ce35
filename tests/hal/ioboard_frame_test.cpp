#include "hal/ioboard/frame.hpp"

#include <gtest/gtest.h>

#include <random>

namespace trivela::hal::ioboard {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

const std::string kStatusBytes = bytes({0x5A, 0x08, 0, 0, 0, 0, 0, 0, 0, 0, 0xF7});
const std::string kShoot100 = bytes({0x5A, 0x02, 0x64, 0, 0, 0, 0, 0, 0, 0, 0x99});
const std::string kHeight120 = bytes({0x5A, 0x07, 0x78, 0, 0, 0, 0, 0, 0, 0, 0x80});

TEST(IoBoardFrame, IsTheBytesOfTheBoardsHost) {
  EXPECT_EQ(encode(frame_of(Command::kStatus)), kStatusBytes);
  EXPECT_EQ(encode(frame_of(Command::kShoot, 100)), kShoot100);
  EXPECT_EQ(encode(frame_of(Command::kHeight, 120)), kHeight120);
}

TEST(IoBoardFrame, CommandPayloadAndSumAddUpToFF) {
  for (int command = 0; command < 256; ++command) {
    const std::string frame = encode({static_cast<Command>(command), {1, 200, 3, 255, 255, 255, 255, 90}});
    unsigned sum = 0;
    for (const char byte : frame.substr(1)) sum += static_cast<unsigned char>(byte);
    EXPECT_EQ(sum & 0xFFU, 0xFFU);
  }
}

TEST(IoBoardFrame, IsReadInAnyPieces) {
  const std::string both = kShoot100 + kHeight120;
  for (std::size_t cut = 0; cut <= both.size(); ++cut) {
    FrameParser parser;
    auto frames = parser.feed(both.substr(0, cut));
    for (const Frame& frame : parser.feed(both.substr(cut))) frames.push_back(frame);
    ASSERT_EQ(frames.size(), 2u) << cut;
    EXPECT_EQ(frames[0], frame_of(Command::kShoot, 100));
    EXPECT_EQ(frames[1], frame_of(Command::kHeight, 120));
    EXPECT_EQ(parser.stray_bytes(), 0u);
  }
}

TEST(IoBoardFrame, IsFoundBehindNoise) {
  FrameParser parser;
  const auto frames = parser.feed(bytes({0x00, 0x5A, 0x17, 0x5A, 0x5A}) + kStatusBytes);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0], frame_of(Command::kStatus));
  EXPECT_EQ(parser.stray_bytes(), 5u);
}

TEST(IoBoardFrame, WithAWrongSumIsNoneAndHidesNoneBehindIt) {
  std::string wrong = kShoot100;
  wrong.back() = static_cast<char>(0x98);
  FrameParser parser;
  const auto frames = parser.feed(wrong + kStatusBytes);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0], frame_of(Command::kStatus));
  EXPECT_EQ(parser.wrong_sums(), 1u);
}

TEST(IoBoardFrame, MayHoldAStartInItsPayload) {
  const Frame frame{Command::kStatus, {0x5A, 0x5A, 0x08, 0x11, 0, 0, 0, 0x5A}};
  FrameParser parser;
  const auto frames = parser.feed(encode(frame_of(Command::kShoot, 0x5A)).substr(2) + encode(frame));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0], frame);
}

TEST(IoBoardFrame, NoBytesGrowTheParserOrInventAFrame) {
  std::mt19937 random(1);
  FrameParser parser;
  std::uint64_t bytes_fed = 0, frames_found = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string noise(random() % 40, '\0');
    for (char& byte : noise) byte = static_cast<char>(random() % 4 == 0 ? 0x5A : random());
    bytes_fed += noise.size();
    frames_found += parser.feed(noise).size();
  }
  // What is not a frame was passed over, but for the beginning of one.
  EXPECT_LE(bytes_fed - parser.stray_bytes() - 11 * frames_found, 10u);
  EXPECT_GT(parser.wrong_sums(), 1000u);
}

}  // namespace
}  // namespace trivela::hal::ioboard
