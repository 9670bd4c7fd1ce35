// Pulses of a board, and what was ordered and said before them. Times in ms.
#include "tests/faults/kicker_timeline.hpp"

#include <gmock/gmock.h>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::faults {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kMsOfTest_ns = 1'000'000;

/// An order at 1,000 and its pulse 2 later, while the game is on.
KickerTimeline timeline_of_a_kick(OrderKind kind = OrderKind::kLawful) {
  KickerTimeline timeline;
  timeline.ordered[7] = {1000 * kMsOfTest_ns, kind, 25};
  timeline.playing[0] = true;
  timeline.pulses = {{1002 * kMsOfTest_ns, 25}};
  return timeline;
}

TEST(KickerTimeline, AFreshLawfulOrderInPlayIsFired) {
  const JudgedPulses judged = judge_pulses(timeline_of_a_kick());
  EXPECT_THAT(judged.complaints, IsEmpty());
  ASSERT_EQ(judged.kicks.size(), 1U);
  EXPECT_EQ(judged.kicks[0].kick_id, 7);
}

TEST(KickerTimeline, APulseForAnUnauthorisedOrderALateOneAndASecondOneAreTold) {
  EXPECT_THAT(judge_pulses(timeline_of_a_kick(OrderKind::kUnauthorised)).complaints,
              ElementsAre(HasSubstr("without a lawful")));
  KickerTimeline late = timeline_of_a_kick();
  late.pulses[0].t_ns = 1200 * kMsOfTest_ns;
  EXPECT_THAT(judge_pulses(late).complaints, ElementsAre(HasSubstr("200 ms after order 7")));
  KickerTimeline twice = timeline_of_a_kick();
  twice.pulses.push_back({1010 * kMsOfTest_ns, 25});
  EXPECT_THAT(judge_pulses(twice).complaints, ElementsAre(HasSubstr("without a lawful")));
}

TEST(KickerTimeline, WhatLayInALineThatHeldItBackMayComeLater) {
  KickerTimeline held = timeline_of_a_kick();
  held.pulses[0].t_ns = 1400 * kMsOfTest_ns;
  held.troubles[990 * kMsOfTest_ns] = Trouble::kHold;
  EXPECT_THAT(judge_pulses(held).complaints, IsEmpty());
}

TEST(KickerTimeline, APulseWhileTheGameStandsIsTold) {
  KickerTimeline stopped = timeline_of_a_kick();
  stopped.playing[900 * kMsOfTest_ns] = false;
  EXPECT_THAT(judge_pulses(stopped).complaints, ElementsAre(HasSubstr("while the game stands")));
  stopped.playing[1001 * kMsOfTest_ns] = true;
  EXPECT_THAT(judge_pulses(stopped).complaints, IsEmpty()) << "it starts at that moment";
}

class KicksOfALog : public evaluator::LogTest {};

TEST_F(KicksOfALog, AKickWithoutAReceiptIsCoveredByTheDriversOwnSilenceAlone) {
  {
    log::Writer writer{path(), session(), options()};
    writer.silence({"kicker_status", 1, 1000 * kMsOfTest_ns, 1300 * kMsOfTest_ns});
    writer.silence({"odometry", 1, 1000 * kMsOfTest_ns, 3000 * kMsOfTest_ns});
  }
  const auto kick = [](std::int64_t t_ms) { return FireSeen{t_ms * kMsOfTest_ns, t_ms * kMsOfTest_ns, 7, false}; };
  EXPECT_THAT(unlogged({kick(1010)}, path()), IsEmpty());
  EXPECT_THAT(unlogged({kick(1400)}, path()), ElementsAre("kick 7 was neither logged nor in a counted gap"));
  EXPECT_THAT(unlogged({kick(990)}, path()), testing::SizeIs(1));
}

}  // namespace
}  // namespace trivela::faults
