#include "nodes/runtime/log_sinks.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <sstream>
#include <vector>

namespace trivela::nodes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Limited {
  std::ostringstream out;
  std::shared_ptr<spdlog::sinks::sink> sink = [this] {
    auto plain = std::make_shared<spdlog::sinks::ostream_sink_mt>(out);
    plain->set_pattern("%v");
    return std::make_shared<LimitedSink>(plain);
  }();

  void say(const std::string& text, double at_s) {
    const spdlog::log_clock::time_point when{
        std::chrono::duration_cast<spdlog::log_clock::duration>(std::chrono::duration<double>{1000.0 + at_s})};
    sink->log(spdlog::details::log_msg{when, {}, "node", spdlog::level::warn, text});
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> found;
    std::istringstream in{out.str()};
    for (std::string line; std::getline(in, line);) found.push_back(line);
    return found;
  }
};

TEST(LimitedSink, PassesAFewLinesOfAKindInASecondAndCountsTheRest) {
  Limited limited;
  for (int i = 0; i < 1000; ++i) limited.say(fmt::format("kick {} refused: stale", i), i * 0.0009);
  limited.say("kick 1000 refused: stale", 1.5);
  EXPECT_THAT(limited.lines(), ElementsAre("kick 0 refused: stale", "kick 1 refused: stale", "kick 2 refused: stale",
                                           HasSubstr("997 more like this"), "kick 1000 refused: stale"));
}

TEST(LimitedSink, KeepsKindsApart) {
  Limited limited;
  for (int i = 0; i < 3; ++i) limited.say("one", 0.0);
  limited.say("two", 0.0);
  EXPECT_THAT(limited.lines(), ElementsAre("one", "one", "one", "two"));
}

TEST(LimitedSink, SaysWhatItHeldBackWhenItEnds) {
  Limited limited;
  for (int i = 0; i < 5; ++i) limited.say("one", 0.0);
  limited.sink.reset();
  EXPECT_THAT(limited.lines(), ElementsAre("one", "one", "one", HasSubstr("2 more like this")));
}

TEST(LimitedSink, IsBoundedHoweverManyKindsThereAreAndHoweverLongTheyAre) {
  Limited limited;
  for (int i = 0; i < 5000; ++i)
    limited.say(std::string(1 + i % 40, static_cast<char>('a' + i / 40 % 26)) + std::string(2000, 'x'), i * 0.0001);
  limited.sink.reset();
  EXPECT_LT(limited.out.str().size(), 64u * 1024);
}

}  // namespace
}  // namespace trivela::nodes
