#include "tests/faults/drivers_words.hpp"

#include <gmock/gmock.h>

#include "tests/faults/fire_rules.hpp"

namespace trivela::faults {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kMs = 1'000'000;

/// A link from the referee to the driver that is late by 72 to 132 ms from 1 s to 3 s.
Trial late_link() {
  Trial trial;
  trial.fault = {
      .kind = FaultKind::kDelay, .node = node_index("referee"), .other = node_index("kicker_driver"), .way = {}};
  trial.fault.way = {.delay = std::chrono::milliseconds{72}, .jitter = std::chrono::milliseconds{60}};
  trial.began_ns = 1000 * kMs;
  trial.ended_ns = trial.whole_ns = 3000 * kMs;
  return trial;
}

/// The game stands from 1.5 s to 2 s; a word each 100 ms.
Testimony said() {
  Testimony wire;
  for (std::int64_t t_ms = 0; t_ms <= 4000; t_ms += 100)
    wire.words.push_back({t_ms * kMs, t_ms < 1500 || t_ms >= 2000});
  return wire;
}

/// What is found of one fire for a fresh order at an instant, where the witness heard each word `late_ms` after it was
/// said.
std::vector<Finding> found(std::int64_t fired_ms, std::int64_t late_ms, const std::vector<Trial>& trials) {
  Testimony device, wire = said();
  for (const CommandSeen& word : wire.words) device.words.push_back({word.arrival_ns + late_ms * kMs, word.playing});
  device.fires.push_back({fired_ms * kMs, fired_ms * kMs, 1});
  device.orders.push_back({(fired_ms - 10) * kMs, (fired_ms - 10) * kMs, 1, fired_ms * kMs, (fired_ms + 50) * kMs});
  return judge(with_drivers_words(device, wire, trials), wire, {});
}

TEST(DriversWords, AFireBetweenTheEarliestCopyOfTheStartAndTheWitnessesIsNone) {
  EXPECT_THAT(found(2080, 130, {late_link()}), IsEmpty());
  EXPECT_THAT(found(2080, 130, {}), SizeIs(1)) << "on a sound way the witness is the measure";
}

TEST(DriversWords, AFireBeforeTheStartCanHaveArrivedIsWhileStopped) {
  for (const std::int64_t fired_ms : {1700, 1900, 2060})
    EXPECT_THAT(found(fired_ms, 130, {late_link()}), SizeIs(1)) << fired_ms;
}

TEST(DriversWords, AFireBeforeTheLastCopyOfTheStopIsNone) {
  EXPECT_THAT(found(1625, 75, {late_link()}), IsEmpty());
  EXPECT_THAT(found(1660, 75, {late_link()}), SizeIs(1));
}

TEST(DriversWords, AfterTheFaultTheWitnessIsTheMeasureAgain) {
  Trial short_one = late_link();
  short_one.ended_ns = 1200 * kMs;
  EXPECT_THAT(found(2080, 130, {short_one}), SizeIs(1));
}

/// All that the referee says is late by 40 to 190 ms from 1 s to 1.8 s.
Trial late_referee() {
  Trial trial;
  trial.fault = {.kind = FaultKind::kDelay, .node = node_index("referee"), .other = {}, .way = {}};
  trial.fault.way = {.delay = std::chrono::milliseconds{40}, .jitter = std::chrono::milliseconds{150}};
  trial.began_ns = 1000 * kMs;
  trial.ended_ns = trial.whole_ns = 1800 * kMs;
  return trial;
}

TEST(DriversWords, ARepeatedStopThatTheFaultHeldBackDoesNotComeAfterTheWordToPlay) {
  EXPECT_THAT(found(2090, 0, {late_referee()}), IsEmpty())
      << "he was to play at 2 s, and the last stop came at 2.05 s at most";
  EXPECT_THAT(found(1700, 0, {late_referee()}), SizeIs(1)) << "the first stop came at 1.65 s at most";
  EXPECT_THAT(found(1640, 0, {late_referee()}), IsEmpty());
}

TEST(DriversWords, AStopOnItsWayWhenTheFaultEndsMayComeLater) {
  Trial short_one = late_referee();
  short_one.ended_ns = 1330 * kMs;
  EXPECT_THAT(found(1610, 0, {short_one}), IsEmpty()) << "said at 1.31 s at the earliest";
  short_one.ended_ns = 1300 * kMs;
  EXPECT_THAT(found(1610, 0, {short_one}), SizeIs(1)) << "said after the fault";
}

TEST(DriversWords, ADelayOnAnotherWayChangesNothing) {
  Trial other = late_link();
  other.fault.other = node_index("recorder");
  EXPECT_THAT(found(2080, 130, {other}), SizeIs(1));
}

}  // namespace
}  // namespace trivela::faults
