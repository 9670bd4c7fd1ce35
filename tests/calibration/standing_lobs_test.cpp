// The standing kicks over the scanner: how many more are needed, and when a table may be made of them.
#include "calibration/standing_lobs.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "calibration/field_calibration.hpp"
#include "calibration/scanner_session.hpp"
#include "config/text/error.hpp"
#include "tests/support/folder.hpp"

namespace trivela::calibration {
namespace {

using kicking::lob::LobRecord;
using kicking::lob::Refusal;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

LobRecord lob(double power, Refusal refusal = Refusal::kNone) {
  LobRecord record;
  record.power = power;
  record.refusal = refusal;
  record.effective.emplace();
  return record;
}

TEST(StandingLobs, ALobCountsWithAFitAPowerAndNoRefusal) {
  EXPECT_TRUE(is_trial(lob(15)));
  EXPECT_FALSE(is_trial(lob(15, Refusal::kBadFit)));
  LobRecord without_power = lob(15), without_fit = lob(15);
  without_power.power.reset();
  without_fit.effective.reset();
  EXPECT_FALSE(is_trial(without_power));
  EXPECT_FALSE(is_trial(without_fit));
}

TEST(StandingLobs, KicksAndLobsOfAllRoundsAreCountedByPower) {
  DriveRecord first, second;
  first.kicked_powers = {15, 15, 20};
  first.lobs = {lob(15), lob(15, Refusal::kBadFit)};
  second.kicked_powers = {20};
  second.lobs = {lob(20)};
  const auto tallies = tallies_of({15, 20, 25}, {first, second});
  ASSERT_EQ(tallies.size(), 3u);
  EXPECT_EQ(tallies.at(15).kicks, 2u);
  EXPECT_EQ(tallies.at(15).lobs, 1u);
  EXPECT_EQ(tallies.at(20).kicks, 2u);
  EXPECT_EQ(tallies.at(20).lobs, 1u);
  EXPECT_EQ(tallies.at(25).kicks, 0u) << "a set-point that was never kicked is one that needs kicks";
}

TEST(StandingLobs, TheNextRoundKicksOnlyWhatLacksLobsAndByWhatTheScannerMissed) {
  const NextRound none = next_round({{15, {4, 4}}, {20, {9, 5}}}, 4);
  EXPECT_THAT(none.powers, IsEmpty());
  EXPECT_EQ(none.kicks, 0u);
  const NextRound some = next_round({{15, {4, 4}}, {20, {4, 2}}, {25, {4, 3}}}, 4);
  EXPECT_THAT(some.powers, ElementsAre(20, 25));
  EXPECT_EQ(some.kicks, 5u) << "1.2 times 2 lobs at 2.5 of 5, rounded up";
  EXPECT_EQ(next_round({{15, {100, 0}}}, 4).kicks, 40u) << "no round is longer";
}

TEST(StandingLobs, ATableNeedsTwoLobsOfEachSetPoint) {
  EXPECT_NO_THROW(require_lobs({{15, {4, 2}}, {20, {2, 2}}}, 4));
  EXPECT_THAT(
      [] {
        require_lobs({{15, {4, 2}}, {20, {4, 1}}}, 4);
      },
      ThrowsMessage<std::runtime_error>(
          AllOf(HasSubstr("set-point 20: 1 of the 2 lobs that it needs, after 4 kicks; about 4 more kicks"),
                HasSubstr("(now 4 of each set-point)"))));
}

TEST(StandingLobs, EachKickThatGaveNoLobIsSaidWithItsReason) {
  DriveRecord record;
  record.lobs = {lob(15), lob(15, Refusal::kBadFit), lob(15, Refusal::kBadFit), lob(20, Refusal::kTooFewPoints)};
  EXPECT_THAT(without_lob({record}, 6),
              ElementsAre("2 flights: bad_fit", "1 flight: too_few_points", "2 kicks: no flight in the scans"));
  EXPECT_THAT(without_lob({record}, 4), testing::SizeIs(2));
  EXPECT_THAT(without_lob({record}, 3), testing::SizeIs(2)) << "the scanner may see more flights than were ordered";
}

TEST(StandingLobs, SetPointsWithinEachOthersErrorsArePooledAndSaid) {
  std::vector<std::string> left_out;
  const auto rising = fit_rising({{10, 0.7, 5.0}, {20, 0.7, 7.0}}, left_out);
  EXPECT_FALSE(rising.isotonic);
  EXPECT_THAT(left_out, IsEmpty());
  const auto pooled = fit_rising({{10, 0.7, 5.0}, {20, 0.7, 7.0}, {30, 0.7, 6.8}}, left_out);
  EXPECT_TRUE(pooled.isotonic);
  EXPECT_TRUE(pooled.rises());
  EXPECT_THAT(left_out, ElementsAre("order of set-point 30: 6.80 m/s, not faster than a weaker one; pooled"));
}

TEST(ScannerRecord, ThatIsThereAlreadyIsNeverOverwritten) {
  const tests::Folder folder;
  EXPECT_NO_THROW(refuse_existing(folder / "scans.db"));
  std::ofstream{folder / "scans.db"} << "a record";
  EXPECT_THAT([&] { refuse_existing(folder / "scans.db"); },
              ThrowsMessage<config::BadArgument>(
                  AllOf(HasSubstr("scans.db exists already"), HasSubstr("choose another file"))));
}

TEST(FieldSteps, APersonIsToldWhereTheBallLiesAndHowManyKicksFollow) {
  const config::Settings settings;
  DrivePlan plan;
  plan.policy = kicking::PolicyName::kStandingDrive;
  plan.ball_to_goal_m = 6.25;
  plan.possessions = 16;
  plan.laser = true;
  EXPECT_THAT(instructions(plan, settings), AllOf(HasSubstr("ball 6.25 m from the goal line, in the scanner's plane"),
                                                  HasSubstr("\n16 kicks over the scanner. After each")));
  plan.laser = false;
  EXPECT_THAT(instructions(plan, settings), AllOf(HasSubstr("The lever moves: keep hands out of the kicker"),
                                                  HasSubstr("6.25 m"), HasSubstr("\n16 kicks. After each")));
}

}  // namespace
}  // namespace trivela::calibration
