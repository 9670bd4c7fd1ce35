// The recorder's host is cut off for longer than any lease: what stayed away is counted, with its time.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/report_of_log.hpp"
#include "tests/faults/stack.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {
namespace {

using evaluator::RecordedSilence;
using std::chrono::seconds;

constexpr double kOutage_s = 14.0;  // the lease is of 5 s

std::int64_t gaps_of(const evaluator::Report& report, const std::string& stream) {
  for (const auto& loss : report.losses) {
    if (loss.stream == stream) return loss.gaps;
  }
  return 0;
}

bool has_silence(const evaluator::Report& report, const std::string& stream, double at_least_s) {
  return std::ranges::any_of(report.silences, [&](const RecordedSilence& silence) {
    return silence.stream == stream && silence.to_s() && *silence.to_s() - silence.from_s() >= at_least_s;
  });
}

TEST(Outage, OfFourteenSecondsIsInTheReportWithItsKicks) {
  if (const std::string obstacle = NetworkHost::obstacle(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  const tests::Folder folder;
  StackPlan plan;
  plan.programs = TRIVELA_BINARY_DIR;
  plan.own = std::filesystem::path{TRIVELA_BINARY_DIR} / "tests";
  plan.folder = folder.path();
  Stack stack{plan};
  stack.start_all();
  const auto fires = [&] { return stack.wire().fires.size(); };
  ASSERT_TRUE(stack.listen(seconds{120}, [&] { return fires() >= 5 && stack.log_changed(); })) << "nothing is played";

  Fault cut;
  cut.kind = FaultKind::kCut;
  cut.node = node_index("recorder");
  cut.way.drop = 1.0;
  const std::size_t before = fires();
  stack.disturb(cut);
  stack.listen(std::chrono::milliseconds{static_cast<int>(kOutage_s * 1e3)}, [] { return false; });
  const std::size_t meanwhile = fires() - before;
  stack.sound();
  // Twice the lease, and kicks.
  stack.listen(seconds{12}, [] { return false; });
  ASSERT_TRUE(stack.listen(seconds{60}, [&] { return fires() >= before + meanwhile + 5; }));
  stack.stop_all();

  ASSERT_EQ(stack.logs().size(), 1u) << "the recorder goes on with its log";
  const evaluator::Report report = evaluator::make_report(log::Reader(stack.logs().front()));
  SCOPED_TRACE(evaluator::to_text(report));
  const auto cycles = static_cast<std::int64_t>(kOutage_s / 0.02);
  for (const char* const stream : {"odometry", "world_states", "kicker_status", "vision_frames"}) {
    EXPECT_GE(gaps_of(report, stream), cycles * 8 / 10) << stream;
    EXPECT_TRUE(has_silence(report, stream, 0.9 * kOutage_s)) << stream;
  }
  ASSERT_GE(meanwhile, 2u);
  EXPECT_GE(gaps_of(report, "kick_receipts"), static_cast<std::int64_t>(meanwhile) - 2);
  EXPECT_TRUE(has_silence(report, "kick_receipts", 0.0));
  ASSERT_EQ(report.unrecorded_orders.size(), 1u);
  EXPECT_GE(report.unrecorded_orders[0].kicks_within, static_cast<std::int64_t>(meanwhile) - 2);
  EXPECT_LE(report.unrecorded_orders[0].kicks_within, static_cast<std::int64_t>(meanwhile) + 4);
  EXPECT_TRUE(report.data_lost());
}

}  // namespace
}  // namespace trivela::faults
