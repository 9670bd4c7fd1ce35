#include "hal/refbox/words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trivela::hal::refbox {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using namespace std::string_literals;

std::vector<std::string> texts(const std::vector<Framed>& framed) {
  std::vector<std::string> out;
  for (const Framed& one : framed) out.push_back(one.overlong ? "overlong" : one.text);
  return out;
}

TEST(RefboxFraming, AnObjectEndsWithItsNul) {
  Framing framing;
  EXPECT_THAT(texts(framing.add("{}\0"s)), ElementsAre("{}"));
  EXPECT_EQ(framing.pending_bytes(), 0U);
}

TEST(RefboxFraming, OneReadMayBringSeveralObjectsAndABeginning) {
  Framing framing;
  EXPECT_THAT(texts(framing.add("{1}\0{2}\0{3"s)), ElementsAre("{1}", "{2}"));
  EXPECT_THAT(texts(framing.add("}\0"s)), ElementsAre("{3}"));
}

TEST(RefboxFraming, AnObjectMayComeByteByByte) {
  Framing framing;
  const std::string stream = "{\"a\":1}\0{}\0"s;
  std::vector<std::string> all;
  for (const char byte : stream)
    for (const std::string& text : texts(framing.add({&byte, 1}))) all.push_back(text);
  EXPECT_THAT(all, ElementsAre("{\"a\":1}", "{}"));
}

TEST(RefboxFraming, NothingBetweenTwoNulsIsNoObject) {
  Framing framing;
  EXPECT_THAT(texts(framing.add("\0\0 \r\n\0{}\0\0"s)), ElementsAre("{}"));
}

TEST(RefboxFraming, TheLongestObjectIsWholeAndALongerOneIsLeftOutAndSaid) {
  Framing framing;
  EXPECT_THAT(texts(framing.add(std::string(kLongestObject_B, 'x') + '\0')),
              ElementsAre(std::string(kLongestObject_B, 'x')));
  EXPECT_THAT(texts(framing.add(std::string(kLongestObject_B + 1, 'x') + "\0{}\0"s)), ElementsAre("overlong", "{}"));
}

TEST(RefboxFraming, AnEndlessObjectTakesNoMemory) {
  Framing framing;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_THAT(framing.add(std::string(10'000, 'x')), IsEmpty());
    ASSERT_LE(framing.pending_bytes(), kLongestObject_B);
  }
  EXPECT_THAT(texts(framing.add("\0{}\0"s)), ElementsAre("overlong", "{}"));
}

}  // namespace
}  // namespace trivela::hal::refbox
