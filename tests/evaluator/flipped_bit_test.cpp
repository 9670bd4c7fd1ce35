// A log of which one bit was flipped is refused, or says what it said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <random>

#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

/// The report's text; none: the log is refused with a sentence that names it.
std::optional<std::string> said(const std::filesystem::path& path) {
  try {
    return to_text(make_report(log::Reader(path)));
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
    return std::nullopt;
  }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FlippedBit : public LogTest {
 protected:
  FlippedBit() {
    MatchLog match(path(), session(), options());
    match.referee(0.0, 1, true);
    match.kicks(1, "on_target", 8);
    match.kicks(1, "over", 4);
    match.referee(60.0, 1, false);
    match.referee(60.0, 2, true);
    match.kicks(2, "on_target", 9);
    match.kicks(2, "post", 3);
    match.truth(match.kick(2, "wide_left"), "wide_left");
    match.receipt(match.decide(2), "stale");
    match.referee(120.0, 2, false);
    match.close();
  }

  void write(const std::string& bytes) const { std::ofstream(flipped, std::ios::binary) << bytes; }

  const std::filesystem::path flipped = path("flipped.db");
};

TEST_F(FlippedBit, NeverChangesTheReport) {
  const std::string intact = bytes_of(path());
  write(intact);
  const auto report = said(flipped);
  ASSERT_TRUE(report);
  constexpr int kFlips = 500;
  int refused = 0;
  for (int seed = 1; seed <= kFlips; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::size_t place = random() % intact.size();
    // Most of a short log is empty: every other flip is where something stands.
    while (seed % 2 == 0 && intact[place] == '\0') place = random() % intact.size();
    std::string bytes = intact;
    bytes[place] = static_cast<char>(static_cast<unsigned char>(bytes[place]) ^ (1u << (random() % 8)));
    write(bytes);
    const auto now = said(flipped);
    refused += now ? 0 : 1;
    EXPECT_EQ(now.value_or(*report), *report) << "seed " << seed << ", byte " << place;
  }
  RecordProperty("refused", refused);
  std::printf("%d of %d flips refused, the others change nothing\n", refused, kFlips);
  EXPECT_GT(refused, kFlips / 3) << "the flips must hit something";
}

}  // namespace
}  // namespace trivela::evaluator
