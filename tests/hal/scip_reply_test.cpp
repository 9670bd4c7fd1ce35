#include "hal/scip/reply.hpp"

#include <gtest/gtest.h>

#include "hal/scip/messages.hpp"
#include "tests/hal/scip_text.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::size_t kBeams = 48;

std::vector<std::uint32_t> expected_ranges() {
  std::vector<std::uint32_t> ranges;
  for (const auto& row : tests::rows("scip_md_block_expected.csv")) {
    ranges.push_back(static_cast<std::uint32_t>(row.number("range_mm")));
  }
  return ranges;
}

// All replies of `text`, fed in pieces of `size` bytes.
std::vector<Reply> read_in_pieces(ReplyParser& parser, std::string_view text, std::size_t size) {
  std::vector<Reply> replies;
  for (std::size_t at = 0; at < text.size(); at += size) {
    for (Reply& reply : parser.feed(text.substr(at, size))) replies.push_back(std::move(reply));
  }
  return replies;
}

void expect_the_recorded_scan(const Reply& reply) {
  EXPECT_EQ(reply.echo, "MD0000004700000");
  EXPECT_EQ(reply.status, "99");
  EXPECT_EQ(reply.stamp_ms, decode("0N90").value());
  EXPECT_EQ(ranges_of(reply, kBeams), expected_ranges());
}

TEST(ScipReply, ReadsTheRecordedScanWithValuesAcrossBlocks) {
  ReplyParser parser;
  const auto replies = parser.feed(tests::recorded_scan());
  ASSERT_EQ(replies.size(), 1U);
  expect_the_recorded_scan(replies.front());
}

TEST(ScipReply, EveryChunkingGivesTheSame) {
  const std::string text = tests::recorded_scan() + tests::urg_version() + tests::recorded_scan();
  for (std::size_t size = 1; size <= text.size(); ++size) {
    SCOPED_TRACE(size);
    ReplyParser parser;
    const auto replies = read_in_pieces(parser, text, size);
    ASSERT_EQ(replies.size(), 3U);
    expect_the_recorded_scan(replies[0]);
    EXPECT_EQ(replies[1].echo, "VV");
    EXPECT_EQ(replies[1].lines.back(), "SERI:H0508486");
    expect_the_recorded_scan(replies[2]);
    EXPECT_EQ(parser.take_damages().torn, 0U);
  }
}

TEST(ScipReply, EverySplitInTwoGivesTheSame) {
  const std::string text = tests::recorded_scan();
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    ReplyParser parser;
    auto replies = parser.feed(std::string_view{text}.substr(0, cut));
    for (Reply& reply : parser.feed(std::string_view{text}.substr(cut))) replies.push_back(std::move(reply));
    ASSERT_EQ(replies.size(), 1U) << cut;
    EXPECT_EQ(ranges_of(replies.front(), kBeams), expected_ranges()) << cut;
  }
}

TEST(ScipReply, OneOtherByteAnywhereCostsThisReplyAloneAndIsCountedOnce) {
  const std::string good = tests::recorded_scan();
  const std::size_t echo_ends = good.find('\n');  // the echo has no sum
  for (std::size_t at = echo_ends; at + 1 < good.size(); ++at) {
    for (const int change : {1, 2, 32, -1}) {
      SCOPED_TRACE(at);
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] + change);
      if (bad[at] == '\n') continue;
      ReplyParser parser;
      const auto replies = parser.feed(good + bad + good);
      const Damages damages = parser.take_damages();
      ASSERT_EQ(replies.size(), 2U);
      EXPECT_EQ(damages.torn + damages.wrong_sums, 1U);
      expect_the_recorded_scan(replies.front());
      expect_the_recorded_scan(replies.back());
    }
  }
}

TEST(ScipReply, LostBytesAnywhereCostOneReply) {
  const std::string good = tests::recorded_scan();
  const std::size_t echo_ends = good.find('\n');
  for (std::size_t from = echo_ends + 1; from < good.size(); ++from) {
    for (const std::size_t count : {1U, 2U, 20U, 70U}) {
      SCOPED_TRACE(testing::Message() << from << " " << count);
      if (from + count > good.size()) continue;
      std::string bad = good;
      bad.erase(from, count);
      ReplyParser parser;
      const auto replies = parser.feed(bad + good);
      ASSERT_GE(replies.size(), 1U);
      expect_the_recorded_scan(replies.back());
      const Damages damages = parser.take_damages();
      EXPECT_LE(damages.torn + damages.wrong_sums, 1U);
      // What is left may look like a whole reply of fewer beams: then the count of its values tells.
      if (replies.size() == 2) {
        EXPECT_FALSE(ranges_of(replies.front(), kBeams));
      }
    }
  }
}

TEST(ScipReply, AWrongSumIsAWrongSumAndAShortBlockIsTorn) {
  std::string text = tests::recorded_scan();
  const std::size_t block_ends = text.find("0c\n") + 1;
  ReplyParser parser;
  std::string wrong = text;
  wrong[block_ends] = 'd';
  EXPECT_TRUE(parser.feed(wrong).empty());
  EXPECT_EQ(parser.take_damages().wrong_sums, 1U);
  std::string torn = text;
  torn.erase(block_ends - 10, 5);
  EXPECT_TRUE(parser.feed(torn).empty());
  EXPECT_EQ(parser.take_damages().torn, 1U);
}

TEST(ScipReply, BytesThatAreNoTextAreTornWhateverTheirSum) {
  const std::string product = "PROD:UTM\xff\xfe";
  int sum = 0;
  for (const char c : product) sum += static_cast<unsigned char>(c);
  ReplyParser parser;
  EXPECT_TRUE(parser.feed("VV\n00P\n" + product + ";" + static_cast<char>((sum & 0x3f) + 0x30) + "\n\n").empty());
  EXPECT_EQ(parser.take_damages().torn, 1U);
}

TEST(ScipReply, ALostEmptyLineDoesNotCostTheNextScan) {
  std::string bad = tests::recorded_scan();
  bad.pop_back();
  ReplyParser parser;
  const auto replies = parser.feed(bad + tests::recorded_scan());
  ASSERT_EQ(replies.size(), 1U);
  expect_the_recorded_scan(replies.front());
  EXPECT_EQ(parser.take_damages().torn, 1U);
}

TEST(ScipReply, ReadsTheOldFormOfTheAnswerToScip20) {
  ReplyParser parser;
  const auto replies = parser.feed("SCIP2.0\n0\n\nQT\n00P\n\n");
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].status, "00");
  EXPECT_EQ(replies[1].echo, "QT");
  EXPECT_TRUE(parser.feed("QT\n0\n\n").empty());
  EXPECT_EQ(parser.take_damages().torn, 1U);
}

TEST(ScipReply, EndlessLinesAndRepliesAreSkippedAndTheNextOneIsRead) {
  for (const std::string& junk :
       {std::string(1'000'000, 'x'), std::string("0123456789abcde\n"), std::string("\0\n", 2)}) {
    ReplyParser parser;
    for (std::size_t sent = 0; sent < 1'000'000; sent += junk.size()) EXPECT_TRUE(parser.feed(junk).empty());
    parser.feed("\n\n");
    EXPECT_GE(parser.take_damages().torn, 1U);
    ASSERT_EQ(parser.feed(tests::recorded_scan()).size(), 1U);
  }
}

TEST(ScipReply, EmptyLinesBetweenRepliesAreNothing) {
  ReplyParser parser;
  EXPECT_EQ(parser.feed("\n\n\n" + tests::recorded_scan() + "\n\n" + tests::recorded_scan() + "\n").size(), 2U);
  EXPECT_EQ(parser.take_damages().torn, 0U);
}

}  // namespace
}  // namespace trivela::hal::scip
