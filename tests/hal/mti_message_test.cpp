// The bytes of an Xsens MTi, and the gyro by a line that the test holds the other end of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hal/mti/mti.hpp"
#include "tests/hal/scripted_line.hpp"

namespace trivela::hal::mti {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

// The decoded message of the README of jonlamb-gh/xsens-mti: sample time 24455074, rate (-0.006, 0.008, 0.005) rad/s.
const std::string kGolden =
    bytes({0xFA, 0xFF, 0x36, 0x16,                    //
           0x10, 0x60, 0x04, 0x01, 0x75, 0x27, 0xA2,  //
           0x80, 0x20, 0x0C, 0xBB, 0xC4, 0x9B, 0xA6, 0x3C, 0x03, 0x12, 0x6F, 0x3B, 0xA3, 0xD7, 0x0A, 0x17});

TEST(MtiMessage, HasItsReadingBigEndianAndASumOfZero) {
  const Message message = message_of({.sample_time = 24455074, .rate_radps = {{-0.006, 0.008, 0.005}}});
  EXPECT_EQ(encode(message), kGolden);
  MessageParser parser;
  const auto messages = parser.take(kGolden);
  ASSERT_EQ(messages.size(), 1u);
  const auto reading = reading_of(messages[0]);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->sample_time, 24455074u);
  EXPECT_NEAR((*reading->rate_radps)[2], 0.005, 1e-9);
}

TEST(MtiMessage, ComesInPiecesAmongNoise) {
  MessageParser parser;
  std::vector<Message> messages;
  const std::string stream = bytes({0xFA, 0x00, 0xFA, 0xFF}) + kGolden + "noise" + kGolden;
  for (const char byte : stream) {
    for (Message& message : parser.take({&byte, 1})) messages.push_back(std::move(message));
  }
  EXPECT_EQ(messages.size(), 2u);
}

TEST(MtiMessage, WithAWrongSumIsPassedOver) {
  std::string broken = kGolden;
  broken[8] = static_cast<char>(broken[8] ^ 1);
  MessageParser parser;
  EXPECT_THAT(parser.take(broken + kGolden), ElementsAre(Message{kMtData2, kGolden.substr(4, 22)}));
}

TEST(MtiMessage, MayBeLongerThanOneByteSays) {
  const Message message{0x10, std::string(600, 'x')};
  MessageParser parser;
  EXPECT_THAT(parser.take(encode(message)), ElementsAre(message));
}

TEST(MtiMessage, ItsRateMayBeADoubleAndIsNoFixedPoint) {
  const auto with = [](int format, std::size_t size) {
    Message message{kMtData2, bytes({0x80, 0x20 + format, static_cast<int>(size)}) + std::string(size, '\0')};
    return reading_of(message);
  };
  EXPECT_TRUE(with(3, 24)->rate_radps);
  EXPECT_TRUE(with(8, 12)->rate_radps) << "axes north, west, up";
  EXPECT_TRUE(with(1, 12)->fixed_point);
  EXPECT_TRUE(with(2, 18)->fixed_point);
  EXPECT_FALSE(with(0, 11)->rate_radps);
}

TEST(MtiMessage, WhosePartsDoNotFillItIsNone) {
  EXPECT_FALSE(reading_of({kMtData2, bytes({0x80, 0x20, 0x0C, 0x00})}));
  EXPECT_FALSE(reading_of({kMtData2, bytes({0x80})}));
  EXPECT_FALSE(reading_of({0x10, kGolden.substr(4, 22)}));
}

class MtiTest : public testing::Test {
 protected:
  void receive(const Reading& reading, std::int64_t t_ms) {
    end_.incoming += encode(message_of(reading));
    mti_.step(t_ms * kMs);
  }

  tests::ScriptedEnd end_;
  Mti mti_{std::make_unique<tests::ScriptedLine>(end_), {}};
};

TEST_F(MtiTest, ASampleIsOfItsSampleTimeHoweverLateItWasRead) {
  receive({.sample_time = 1000, .rate_radps = {{0, 0, 0.5}}}, 100);
  EXPECT_EQ(mti_.newest()->t_ns, 100 * kMs);
  receive({.sample_time = 1100, .rate_radps = {{0, 0, 0.75}}}, 150);
  EXPECT_NEAR(static_cast<double>(mti_.newest()->t_ns), 110e6, 1e4) << "by its clock 10 ms later";
  EXPECT_EQ(mti_.newest()->gyro_radps, 0.75);
  EXPECT_EQ(mti_.status(), "/dev/ttyTEST: MTi");
}

TEST_F(MtiTest, WithoutASampleTimeItIsOfItsArrival) {
  receive({.sample_time = {}, .rate_radps = {{0, 0, 0.5}}}, 100);
  EXPECT_EQ(mti_.newest()->t_ns, 100 * kMs);
  EXPECT_THAT(mti_.status(), HasSubstr("without its sample time"));
}

TEST_F(MtiTest, UpsideDownItTurnsTheOtherWay) {
  Mti mti{std::make_unique<tests::ScriptedLine>(end_), {.upside_down = true}};
  end_.incoming = encode(message_of({.sample_time = 1, .rate_radps = {{0, 0, 0.5}}}));
  mti.step(0);
  EXPECT_EQ(mti.newest()->gyro_radps, -0.5);
}

TEST_F(MtiTest, SaysWhatIsMissingInItsSettings) {
  receive({.sample_time = 1, .rate_radps = {}}, 1);
  EXPECT_FALSE(mti_.newest());
  EXPECT_EQ(mti_.status(), "/dev/ttyTEST: no rate of turn (0x8020) in what it says: switch it on");
}

TEST_F(MtiTest, ANumberThatIsNoneIsNoSample) {
  receive({.sample_time = 1, .rate_radps = {{0, 0, std::numeric_limits<double>::quiet_NaN()}}}, 1);
  EXPECT_FALSE(mti_.newest());
}

TEST_F(MtiTest, SilenceIsSaidAndTheLineOpenedAgain) {
  receive({.sample_time = 1, .rate_radps = {{0, 0, 0.5}}}, 1);
  EXPECT_EQ(mti_.next_ns(), 501 * kMs);
  mti_.step(501 * kMs);
  EXPECT_EQ(mti_.status(),
            "/dev/ttyTEST: nothing came for 0.5 s: the gyro is off, in configuration mode, or at another baud rate");
  EXPECT_EQ(mti_.next_ns(), 701 * kMs);
  mti_.step(701 * kMs);
  EXPECT_EQ(end_.opened, 2);
  EXPECT_EQ(end_.written.size(), 0u) << "nothing is written to it";
}

TEST_F(MtiTest, InConfigurationModeItsOtherMessagesAreNamed) {
  end_.incoming = encode({.id = 0x31, .data = ""});  // it has gone to configuration mode
  mti_.step(1 * kMs);
  EXPECT_FALSE(mti_.newest());
  mti_.step(501 * kMs);
  EXPECT_EQ(
      mti_.status(),
      "/dev/ttyTEST: message 0x31 comes, but no measurement (MTData2, 0x36): the gyro is in configuration mode, or "
      "set up for another output");
}

TEST_F(MtiTest, AnUnpluggedOneIsSaid) {
  mti_.step(0);
  end_.plugged = false;
  mti_.step(1);
  EXPECT_EQ(mti_.status(), "/dev/ttyTEST: the line is cut: no such file or directory");
  mti_.step(300 * kMs);
  EXPECT_EQ(mti_.status(), "no gyro at /dev/ttyTEST: no such file or directory");
}

}  // namespace
}  // namespace trivela::hal::mti
