#include "hal/scip/start_up.hpp"

#include <gtest/gtest.h>

#include "tests/hal/scip_text.hpp"

namespace trivela::hal::scip {
namespace {

using Progress = StartUp::Progress;

Reply reply_of(const std::string& text) {
  ReplyParser parser;
  return parser.feed(text).at(0);
}

Progress answer(StartUp& start_up, std::string_view status) {
  return start_up.take(reply_of(plain_reply(start_up.request(), status)));
}

// Up to the request BM.
StartUp known_scanner(Asking asking) {
  StartUp start_up{asking};
  answer(start_up, "00");
  answer(start_up, "0E");
  start_up.take(reply_of(tests::urg_version()));
  start_up.take(reply_of(tests::urg_parameters()));
  start_up.take(reply_of(plain_reply("II", "00", text_line("STAT", "motor stopped"))));
  return start_up;
}

TEST(ScipStartUp, AsksInTurnUntilTheScannerMeasures) {
  StartUp start_up{Asking::kContinuous};
  EXPECT_EQ(start_up.request(), "QT");
  EXPECT_EQ(answer(start_up, "00"), Progress::kNext);
  EXPECT_EQ(start_up.request(), "SCIP2.0");
  EXPECT_EQ(answer(start_up, "0E"), Progress::kNext);
  EXPECT_EQ(start_up.request(), "VV");
  EXPECT_EQ(start_up.take(reply_of(tests::urg_version())), Progress::kNext);
  EXPECT_EQ(start_up.request(), "PP");
  EXPECT_EQ(start_up.take(reply_of(tests::urg_parameters())), Progress::kNext);
  EXPECT_EQ(start_up.request(), "II");
  EXPECT_EQ(answer(start_up, "0E"), Progress::kNext);
  EXPECT_EQ(start_up.request(), "BM");
  EXPECT_EQ(answer(start_up, "02"), Progress::kNext);
  EXPECT_EQ(start_up.request(), "MD0044072501000");
  EXPECT_EQ(answer(start_up, "00"), Progress::kDone);
  EXPECT_EQ(start_up.identity().serial, "H0508486");
  EXPECT_EQ(start_up.parameters().front_step, 384);
}

TEST(ScipStartUp, OneByOneEndsWithTheLaser) {
  StartUp start_up = known_scanner(Asking::kOneByOne);
  EXPECT_EQ(answer(start_up, "00"), Progress::kDone);
}

TEST(ScipStartUp, ScansOfAnEarlierHostPassBy) {
  StartUp start_up{Asking::kContinuous};
  EXPECT_EQ(start_up.take(reply_of(tests::recorded_scan())), Progress::kWaiting);
  EXPECT_EQ(start_up.request(), "QT");
}

TEST(ScipStartUp, ResetsAScannerThatDoesNotQuit) {
  StartUp start_up{Asking::kContinuous};
  EXPECT_EQ(start_up.timed_out(), Progress::kNext);
  EXPECT_EQ(start_up.request(), "RS");
  EXPECT_EQ(start_up.timed_out(), Progress::kNext);
  EXPECT_EQ(start_up.request(), "SCIP2.0");
  EXPECT_EQ(start_up.timed_out(), Progress::kNext);
  EXPECT_EQ(start_up.request(), "VV");
}

TEST(ScipStartUp, RepeatsARequestOnceAndThenGivesUp) {
  StartUp start_up = known_scanner(Asking::kContinuous);
  EXPECT_EQ(start_up.timed_out(), Progress::kNext);
  EXPECT_EQ(start_up.request(), "BM");
  EXPECT_EQ(start_up.timed_out(), Progress::kFailed);
  EXPECT_EQ(start_up.why(), "no answer to BM (it says of itself: motor stopped)");
}

TEST(ScipStartUp, SaysWhyTheScannerRefuses) {
  StartUp start_up = known_scanner(Asking::kContinuous);
  EXPECT_EQ(answer(start_up, "01"), Progress::kFailed);
  EXPECT_EQ(start_up.why(), "the laser does not work (it says of itself: motor stopped)");
}

TEST(ScipStartUp, RefusesAnswersThatAreNoScanners) {
  StartUp start_up{Asking::kContinuous};
  answer(start_up, "00");
  answer(start_up, "00");
  StartUp other = start_up;
  EXPECT_EQ(answer(other, "00"), Progress::kFailed);
  EXPECT_EQ(other.why(), "its answer to VV does not say who it is");
  start_up.take(reply_of(tests::urg_version()));
  EXPECT_EQ(start_up.take(reply_of(tests::urg_parameters("0"))), Progress::kFailed);
  EXPECT_EQ(start_up.why(), "its answer to PP is not that of a scanner");
}

}  // namespace
}  // namespace trivela::hal::scip
