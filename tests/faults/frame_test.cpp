#include "tests/faults/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "tests/faults/rtps_writer.hpp"

namespace trivela::faults {
namespace {

constexpr std::size_t kHeaders = 14 + 20 + 8;

/// Ethernet, IPv4 and UDP around `size` bytes of payload.
std::vector<std::uint8_t> datagram(std::size_t size) {
  std::vector<std::uint8_t> frame(kHeaders + size, 0);
  frame[0] = 2;
  frame[5] = 7;  // to host 7
  frame[12] = 0x08;
  frame[14] = 0x45;
  frame[14 + 9] = 17;
  frame[14 + 20 + 4] = static_cast<std::uint8_t>((size + 8) >> 8);
  frame[14 + 20 + 5] = static_cast<std::uint8_t>(size + 8);
  frame[14 + 20 + 6] = 0xab;
  return frame;
}

TEST(Frame, KnowsItsReceiver) {
  auto frame = datagram(10);
  EXPECT_EQ(receiver_of(frame), 7);
  frame[0] = 0xff;
  EXPECT_EQ(receiver_of(frame), std::nullopt) << "to everybody";
  EXPECT_EQ(receiver_of(std::span{frame}.first(5)), std::nullopt);
}

TEST(Frame, UdpPayloadIsFoundInDatagramsAlone) {
  auto frame = datagram(10);
  EXPECT_EQ(udp_payload(frame).size(), 10u);
  EXPECT_EQ(udp_payload(frame).data(), frame.data() + kHeaders);
  EXPECT_TRUE(udp_payload(Frame{frame}.first(kHeaders + 9)).empty()) << "shorter than it says";
  frame[14 + 9] = 6;
  EXPECT_TRUE(udp_payload(frame).empty()) << "TCP";
  frame = datagram(10);
  frame[14 + 7] = 1;
  EXPECT_TRUE(udp_payload(frame).empty()) << "a fragment";
  frame = datagram(10);
  frame[13] = 0x06;
  EXPECT_TRUE(udp_payload(frame).empty()) << "ARP";
}

TEST(Frame, GarblingTurnsBitsOfThePayloadOverAndVoidsTheChecksum) {
  std::mt19937_64 random{1};
  for (int round = 0; round < 100; ++round) {
    const auto before = datagram(50);
    auto after = before;
    ASSERT_TRUE(garble(after, 8, random));
    int turned = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool checksum = i == 14 + 20 + 6 || i == 14 + 20 + 7;
      if (i < kHeaders && !checksum) {
        EXPECT_EQ(before[i], after[i]) << i;
      }
      if (i >= kHeaders) turned += std::popcount(static_cast<unsigned>(before[i] ^ after[i]));
    }
    EXPECT_LE(turned, 8);
    EXPECT_EQ(after[14 + 20 + 6], 0);
  }
}

TEST(Frame, OneWritersWordsAreMutedAndNoOthers) {
  const auto guid = guid_of("000102030405060708090a0b00000103");
  ASSERT_TRUE(guid);
  constexpr std::size_t kData = kHeaders + 20, kHeartbeat = kData + 4 + 24;
  auto frame = datagram(20 + 4 + 24 + 4 + 28);
  for (std::size_t i = 0; i < 12; ++i) frame[kHeaders + 8 + i] = static_cast<std::uint8_t>(i);
  frame[kData] = 0x15;
  frame[kData + 1] = 1;
  frame[kData + 2] = 24;  // bytes until the next submessage
  std::copy(guid->begin() + 12, guid->end(), frame.begin() + kData + 12);
  frame[kHeartbeat] = 0x07;
  frame[kHeartbeat + 1] = 1;
  frame[kHeartbeat + 2] = 28;
  std::copy(guid->begin() + 12, guid->end(), frame.begin() + kHeartbeat + 8);
  auto other = *guid;
  other.back() = 4;
  auto muted = frame;
  EXPECT_FALSE(mute(muted, other));
  EXPECT_EQ(muted, frame);
  EXPECT_TRUE(mute(muted, *guid));
  EXPECT_EQ(muted[kData + 12], 0xff);
  EXPECT_EQ(muted[kHeartbeat + 8], 0xff);
  EXPECT_FALSE(mute(muted, *guid)) << "nothing is left of it";
}

TEST(Frame, AGuidIsThirtyTwoDigits) {
  EXPECT_FALSE(guid_of("0001"));
  EXPECT_FALSE(guid_of("x00102030405060708090a0b00000103"));
  EXPECT_EQ((*guid_of("000102030405060708090a0bff000103"))[12], 0xff);
}

TEST(Frame, WhatHasNoPayloadIsLeftAsItIs) {
  std::mt19937_64 random{1};
  auto empty = datagram(0);
  const auto before = empty;
  EXPECT_FALSE(garble(empty, 8, random));
  EXPECT_EQ(empty, before);
}

}  // namespace
}  // namespace trivela::faults
