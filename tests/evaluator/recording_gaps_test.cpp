#include "evaluator/sessions/recording_gaps.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

class RecordingGaps : public LogTest {
 protected:
  Report report() const { return make_report(log::Reader(path())); }
  static log::Session continuing(std::vector<log::DriverCount> drivers) {
    auto later = session();
    later.continues_uuid = "11111111-2222-4333-8444-555555555555";
    later.continued = std::move(drivers);
    return later;
  }
};

TEST_F(RecordingGaps, ASilenceStandsInTheLogWhileItLasts) {
  MatchLog match(path(), session(), options());
  match.writer().silence({"odometry", 1, 12 * kSecond});
  match.writer().flush();
  const auto silences = silences_of(log::Reader(path()));
  ASSERT_THAT(silences, SizeIs(1));
  EXPECT_EQ(silences[0].stream, "odometry");
  EXPECT_EQ(silences[0].from_t_ns, 12 * kSecond);
  EXPECT_FALSE(silences[0].to_t_ns);
}

TEST_F(RecordingGaps, ASilenceThatEndedIsOneRowAndLoss) {
  MatchLog match(path(), session(), options());
  match.writer().silence({"odometry", 1, 12'340'000'020});
  match.writer().flush();
  match.writer().silence({"odometry", 1, 12'340'000'020, 13'600'000'020});
  match.close();
  const Report is = report();
  ASSERT_THAT(is.silences, SizeIs(1));
  EXPECT_TRUE(is.silences[0].counts);
  EXPECT_TRUE(is.data_lost());
  EXPECT_EQ(is.rows_missing(), 0) << "nothing is known of how many rows that were";
  EXPECT_EQ(loss_of(log::Reader(path()), "losses").received, 0);
  EXPECT_THAT(to_text(is), HasSubstr("  odometry of robot 1 silent from 12.34 s to 13.60 s (1.26 s)\n"));
  const auto json = nlohmann::json::parse(to_json(is));
  EXPECT_EQ(json["data_quality"]["silences"][0]["to_t_ns"], 13'600'000'020);
  EXPECT_TRUE(json["data_quality"]["data_lost"]);
}

TEST_F(RecordingGaps, ASilenceThatIsWithdrawnLeavesNoRow) {
  MatchLog match(path(), session(), options());
  match.writer().silence({"odometry", 1, 12 * kSecond});
  match.writer().flush();
  match.writer().withdraw({"odometry", 1, 12 * kSecond, 12 * kSecond + 20});
  match.close();
  EXPECT_THAT(report().silences, IsEmpty());
  EXPECT_FALSE(report().data_lost());
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(RecordingGaps, WhereAllFallsSilentTogetherTheMatchIsOver) {
  MatchLog match(path(), session(), options());
  match.referee(9.0, 1, true);
  match.referee(10.0, 1, true);
  for (const char* const stream : {"odometry", "referee", "vision_frames"})
    match.writer().silence({stream, 1, 10 * kSecond});
  match.close();
  EXPECT_FALSE(report().data_lost());
  EXPECT_THAT(to_text(report()), HasSubstr("odometry of robot 1 silent from 10.00 s to the end, as all of that robot"));
}

TEST_F(RecordingGaps, AStreamThatEndsBeforeItsRobotsOthersIsLoss) {
  MatchLog match(path(), session(), options());
  match.referee(11.5, 1, true);
  match.writer().silence({"odometry", 1, 10 * kSecond});
  match.writer().silence({"odometry", 2, 10 * kSecond});
  match.writer().silence({"referee", 1, 11'500'000'000});
  match.close();
  const Report is = report();
  ASSERT_THAT(is.silences, SizeIs(3));
  EXPECT_TRUE(is.silences[0].counts);
  EXPECT_FALSE(is.silences[1].counts) << "the other robot has no other stream";
  EXPECT_FALSE(is.silences[2].counts);
  EXPECT_TRUE(is.data_lost());
}

TEST_F(RecordingGaps, ManySilencesAreSomeLinesAndAllInJson) {
  MatchLog match(path(), session(), options());
  for (std::int64_t i = 1; i <= 20; ++i)
    match.writer().silence({"odometry", 1, i * kSecond, i * kSecond + kSecond / 2});
  match.close();
  const std::string text = to_text(report());
  EXPECT_THAT(text, HasSubstr("and 12 more silences"));
  EXPECT_THAT(text, Not(HasSubstr("silent from 9.")));
  EXPECT_THAT(nlohmann::json::parse(to_json(report()))["data_quality"]["silences"], SizeIs(20));
}

TEST_F(RecordingGaps, WhereEachOrderHasItsReceiptNothingIsMissing) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  match.kick(1, "on_target");
  match.status(1, 0);
  const auto refused = match.decide(1);
  match.order(refused);
  match.receipt(refused, "stale");
  match.status(2, 1);
  match.kick(1, "over");  // answered after the last status
  match.close();
  EXPECT_THAT(report().unrecorded_orders, IsEmpty());
  EXPECT_FALSE(report().data_lost());
}

TEST_F(RecordingGaps, OrdersWithoutAReceiptAreMissing) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  match.kick(1, "on_target");
  match.status(4, 1);
  match.close();
  const Report is = report();
  ASSERT_THAT(is.unrecorded_orders, SizeIs(1));
  EXPECT_EQ(is.unrecorded_orders[0].orders_within, 3);
  EXPECT_EQ(is.unrecorded_orders[0].kicks_within, 2);
  EXPECT_TRUE(is.data_lost());
  EXPECT_THAT(to_text(is),
              HasSubstr("robot 1: while this log was recorded its driver handled 3 orders, 2 of them kicks "
                        "that the log has no receipt of"));
}

TEST_F(RecordingGaps, ADriverThatStartsAnewCountsFromZero) {
  MatchLog match(path(), session(), options());
  match.status(5, 0);
  match.kick(1, "on_target");
  match.status(6, 0);
  match.status(0, 0);
  match.kick(1, "on_target");
  match.status(2, 0);
  match.close();
  const auto missing = report().unrecorded_orders;
  ASSERT_THAT(missing, SizeIs(1));
  EXPECT_EQ(missing[0].orders_within, 1);
  EXPECT_EQ(missing[0].kicks_within, 1);
}

TEST_F(RecordingGaps, AWithdrawnKickIsOneOrderAndNoKick) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  const auto kick = match.decide(1);
  match.order(kick);
  match.receipt(kick);
  match.receipt(kick, "unarmed");
  match.status(1, 1);
  match.close();
  EXPECT_THAT(report().unrecorded_orders, IsEmpty());
}

TEST_F(RecordingGaps, AnOrderSentTwiceIsTwoOrders) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  const auto kick = match.kick(1, "over");
  match.order(kick);
  match.receipt(kick, "double");
  match.status(3, 1);
  match.close();
  const auto missing = report().unrecorded_orders;
  ASSERT_THAT(missing, SizeIs(1));
  EXPECT_EQ(missing[0].orders_within, 1);
  EXPECT_EQ(missing[0].kicks_within, 1);
}

TEST_F(RecordingGaps, KicksBetweenTwoLogsStandInNone) {
  MatchLog match(path(), continuing({{1, 87, 10}, {2, 3, 0}}), options());
  match.status(95, 11);
  match.kick(1, "over");
  match.status(96, 11);
  match.robot_id = 2;
  match.status(3, 0);
  match.close();
  const Report is = report();
  ASSERT_THAT(is.unrecorded_orders, SizeIs(1));
  EXPECT_EQ(is.unrecorded_orders[0].orders_before, 8);
  EXPECT_EQ(is.unrecorded_orders[0].kicks_before, 7);
  EXPECT_EQ(is.unrecorded_orders[0].orders_within, 0);
  EXPECT_TRUE(is.data_lost());
  const std::string text = to_text(is);
  EXPECT_THAT(text, HasSubstr("it continues session 11111111-2222-4333-8444-555555555555"));
  EXPECT_THAT(text, HasSubstr("robot 1: between the session that this one continues and this one its driver handled 8 "
                              "orders, 7 of them kicks: in no log"));
  const auto json = nlohmann::json::parse(to_json(is));
  EXPECT_EQ(json["sessions"][0]["continues"], "11111111-2222-4333-8444-555555555555");
  EXPECT_EQ(json["data_quality"]["unrecorded_orders"][0]["kicks_before"], 7);
}

TEST_F(RecordingGaps, ADriverThatWasStartedAnewBetweenTwoLogsMayHaveKickedMore) {
  MatchLog match(path(), continuing({{1, 87, 10}}), options());
  match.status(2, 2);
  match.close();
  const Report is = report();
  ASSERT_THAT(is.unrecorded_orders, SizeIs(1));
  EXPECT_TRUE(is.unrecorded_orders[0].restarted_before);
  EXPECT_EQ(is.unrecorded_orders[0].orders_before, 2);
  EXPECT_EQ(is.unrecorded_orders[0].kicks_before, 0);
  EXPECT_TRUE(is.data_lost());
  EXPECT_THAT(to_text(is), HasSubstr("handled at least 2 orders, 0 of them kicks: in no log; it was started again"));
}

TEST_F(RecordingGaps, WhatADriverDidBeforeALogThatContinuesNoneIsSaidAndNoLoss) {
  MatchLog match(path(), session(), options());
  match.status(5, 1);
  match.close();
  const Report is = report();
  EXPECT_THAT(to_text(is),
              HasSubstr("robot 1: before this log began its driver had handled 5 orders, 4 of them kicks"));
  EXPECT_FALSE(is.data_lost());
}

}  // namespace
}  // namespace trivela::evaluator
