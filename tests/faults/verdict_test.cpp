// What a campaign counts against itself.
#include "tests/faults/verdict.hpp"

#include <gmock/gmock.h>

namespace trivela::faults {
namespace {

Trial trial_of(FaultKind kind, double streams_s) {
  Trial trial;
  trial.fault.kind = kind;
  trial.fault.node = node_index("odometry");
  trial.recovered = true;
  trial.streams_s = streams_s;
  return trial;
}

TEST(Verdict, AFaultThatCostsTheTopicsMoreThanTwoSecondsIsCounted) {
  Verdict verdict;
  verdict.trials = {trial_of(FaultKind::kKill, 1.9), trial_of(FaultKind::kCut, 0.1)};
  EXPECT_TRUE(verdict.clean());
  EXPECT_EQ(json(verdict)["streams_slower_than_2_s"], 0);
  verdict.trials.push_back(trial_of(FaultKind::kStop, 2.1));
  EXPECT_FALSE(verdict.clean());
  EXPECT_EQ(json(verdict)["streams_slower_than_2_s"], 1);
  EXPECT_THAT(text(verdict), testing::HasSubstr("topics back after 2.10 s alone"));
}

TEST(Verdict, AfterForgedPacketsItMayTakeFourSeconds) {
  Verdict verdict;
  verdict.trials = {trial_of(FaultKind::kGarble, 3.9)};
  EXPECT_TRUE(verdict.clean());
  verdict.trials.push_back(trial_of(FaultKind::kGarble, 4.1));
  EXPECT_FALSE(verdict.clean());
  EXPECT_EQ(json(verdict)["streams_slower_than_4_s_after_forged_packets"], 1);
  EXPECT_EQ(json(verdict)["streams_slower_than_2_s"], 0);
}

}  // namespace
}  // namespace trivela::faults
