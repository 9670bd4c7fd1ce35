#include "evaluator/table2/table2.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/merged_log.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::ThrowsMessage;

using ReportOfALog = LogTest;

PolicyRow row_of(const Report& report, const std::string& policy) {
  for (const PolicyRow& row : report.policies) {
    if (row.policy == policy) return row;
  }
  return {};
}

TEST_F(ReportOfALog, ThePapersKicksGiveThePapersTable) {
  MatchLog match(path(), session(), options());
  write_table2(match);
  match.close();
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.policies, SizeIs(2));
  EXPECT_EQ(report.policies[0].policy, "stopped");
  EXPECT_EQ(report.policies[0].inside(), 34);
  EXPECT_EQ(report.policies[0].outside(), 31);
  EXPECT_EQ(report.policies[1].policy, "moving");
  EXPECT_EQ(report.policies[1].inside(), 100);
  EXPECT_EQ(report.policies[1].outside(), 32);
  EXPECT_EQ(report.policies[1].of("post"), 30);
  EXPECT_THAT(report.unclosed_kicks, IsEmpty());
  EXPECT_FALSE(report.data_lost());

  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("SIMULATED MATCH"));
  EXPECT_THAT(text, HasSubstr("scenario 'empty_field', seed 7"));
  EXPECT_THAT(text, HasSubstr("  stopped      34       31        0      52.3 %  40.4 % to 64.0 %        -"));
  EXPECT_THAT(text, HasSubstr("  moving      100       32        0      75.8 %  67.8 % to 82.3 %        -"));
  EXPECT_THAT(text, HasSubstr("  stopped         11           0    20      0     0    0        0        0"));
  EXPECT_THAT(text, HasSubstr("trivela compare --counts stopped=34/65 moving=100/132"));
}

/// A configuration as sessions have it, of a robot whose ball lies 0.5 m before its centre.
std::string config_with(const std::string& opponents_half_only) {
  return "### settings\n[rules]\nopponents_half_only = " + opponents_half_only +
         "\ncarry_limit_m = 0.0\n\n### robot\nball_offset_m = 0.5\n";
}

/// Kicks on target with the ball 0.1 m before and behind the half-way line, whichever way the robot faces.
void kick_about_the_line(MatchLog& match) {
  constexpr double kPi = 3.141592653589793;
  for (const auto& [y_m, heading_rad] :
       {std::pair{-0.4, 0.0}, std::pair{-0.6, 0.0}, std::pair{0.6, kPi}, std::pair{0.4, kPi}, std::pair{-0.1, 1.5}}) {
    match.y_m = y_m;
    match.heading_rad = heading_rad;
    match.kick(2, "on_target");
  }
  match.kick(2, "over");
}

TEST_F(ReportOfALog, ABallFromTheOwnHalfIsNoGoalWhereTheRulesOfTheSessionSaySo) {
  log::Session ruled = session();
  ruled.config_toml = config_with("true");
  MatchLog match(path(), ruled, options());
  kick_about_the_line(match);
  match.close();
  const Report report = make_report(log::Reader(path()));
  const PolicyRow moving = row_of(report, "moving");
  EXPECT_EQ(moving.inside(), 2);
  EXPECT_EQ(moving.outside(), 4);
  EXPECT_EQ(moving.of("own_half"), 3);
  const std::string line =
      "3 kicks on target from the own half are outside: the rules of the session count no such goal";
  EXPECT_THAT(report.not_counted, ElementsAre(line));
  EXPECT_THAT(to_text(report), AllOf(HasSubstr(line), HasSubstr("own half  unknown")));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["policies"][1]["misses"]["own_half"], 3);
}

/// Kicks on target after a carry of 2.9 m, of 3.1 m, of 3.1 m in two possessions, and of 3.1 m ended by another policy.
void carry_and_kick(MatchLog& match) {
  for (const double to_y_m : {3.9, 4.1}) {
    match.y_m = 0.5;
    match.hold(2, "not_playing");
    match.hold(2, "no_ball");
    match.y_m = 1.0;
    match.hold(2);
    match.y_m = 2.0;
    match.hold(2);
    match.y_m = to_y_m;
    match.kick(2, "on_target");
  }
  match.kick(2, "on_target");
  match.y_m = 1.0;
  match.hold(1);
  match.y_m = 4.1;
  match.kick(1, "wide_left");
}

TEST_F(ReportOfALog, ABallThatWasCarriedTooFarIsNoGoalWhereTheRulesOfTheSessionSaySo) {
  log::Session ruled = session();
  ruled.config_toml = "### settings\n[rules]\ncarry_limit_m = 3.0\n\n### robot\nball_offset_m = 0.5\n";
  MatchLog match(path(), ruled, options());
  carry_and_kick(match);
  match.close();
  for (const bool tallied : {true, false}) {
    if (!tallied) SQLite::Database(path(), SQLite::OPEN_READWRITE).exec("DELETE FROM tallied_sessions");
    const Report report = make_report(log::Reader(path()));
    const PolicyRow moving = row_of(report, "moving");
    EXPECT_EQ(moving.inside(), 2) << tallied;
    EXPECT_EQ(moving.of("carried_too_far"), 1) << tallied;
    EXPECT_EQ(row_of(report, "stopped").of("carried_too_far"), 0) << "what missed is what it is";
    EXPECT_THAT(report.not_counted, ElementsAre("1 kick on target after the ball was carried too far is outside: the "
                                                "rules of the session count no such goal"));
    EXPECT_THAT(to_text(report), HasSubstr("carried too far  unknown"));
  }
}

TEST_F(ReportOfALog, WithoutALimitABallCountsHoweverFarItWasCarried) {
  for (const std::string limit : {"carry_limit_m = 0.0", "", "carry_limit_m = 3.2"}) {
    log::Session free = session();
    free.config_toml = "### settings\n[rules]\n" + limit + "\n\n### robot\nball_offset_m = 0.5\n";
    MatchLog match(path(limit + ".db"), free, options());
    carry_and_kick(match);
    match.close();
    EXPECT_EQ(row_of(make_report(log::Reader(path(limit + ".db"))), "moving").inside(), 3) << limit;
  }
}

TEST_F(ReportOfALog, WithoutTheRuleABallFromTheOwnHalfCountsAsAnyOther) {
  for (const std::string rule : {"false", "no word of it"}) {
    log::Session free = session();
    free.config_toml = config_with(rule);
    MatchLog match(path(rule), free, options());
    kick_about_the_line(match);
    match.close();
    const Report report = make_report(log::Reader(path(rule)));
    EXPECT_EQ(row_of(report, "moving").inside(), 5) << rule;
    EXPECT_THAT(report.not_counted, IsEmpty()) << rule;
    EXPECT_THAT(to_text(report), Not(HasSubstr("own half"))) << rule;
  }
}

TEST_F(ReportOfALog, JsonHasTheSameNumbers) {
  MatchLog match(path(), session(), options());
  write_table2(match);
  match.close();
  const auto json = nlohmann::json::parse(to_json(make_report(log::Reader(path()))));
  const auto& moving = json["policies"][1];
  EXPECT_EQ(moving["policy"], "moving");
  EXPECT_EQ(moving["inside"], 100);
  EXPECT_EQ(moving["outside"], 32);
  EXPECT_NEAR(moving["efficiency"].get<double>(), 0.7575757576, 1e-10);
  EXPECT_NEAR(moving["wilson95"][0].get<double>(), 0.6778581786, 1e-10);
  EXPECT_NEAR(moving["wilson95"][1].get<double>(), 0.8227253736, 1e-10);
  EXPECT_EQ(moving["misses"]["short"], 2);
  EXPECT_TRUE(moving["kicks_per_min"].is_null());
  EXPECT_TRUE(json["simulated"]);
  EXPECT_EQ(json["sessions"][0]["seed"], 7);
  EXPECT_FALSE(json["data_quality"]["data_lost"]);
}

TEST_F(ReportOfALog, CsvHasALineForEachPolicy) {
  MatchLog match(path(), session(), options());
  write_table2(match);
  match.close();
  const std::string csv = to_csv(make_report(log::Reader(path())));
  EXPECT_THAT(csv, testing::StartsWith("row,arm,policy,robot_id,inside,outside,unknown,efficiency,wilson95_lo,"));
  EXPECT_THAT(csv, HasSubstr("\npolicy,,stopped,,34,31,0,0.52307692"));
  EXPECT_THAT(csv, HasSubstr(",,,11,0,20,0,0,0,0,")) << "no exposure, no rate";
  EXPECT_THAT(csv, HasSubstr("\npolicy,,moving,,100,32,0,"));
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  std::istringstream lines(csv);
  std::string head;
  std::getline(lines, head);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(commas(line), commas(head)) << line;
}

TEST_F(ReportOfALog, TheLatestOutcomeOfAKickHolds) {
  MatchLog match(path(), session(), options());
  const auto kick = match.kick(1, "unknown");
  match.outcome(kick, "over");
  match.outcome(kick, "on_target");
  match.close();
  const auto row = row_of(make_report(log::Reader(path())), "stopped");
  EXPECT_EQ(row.kicks(), 1);
  EXPECT_EQ(row.inside(), 1);
}

TEST_F(ReportOfALog, BallsThatBouncedInAreCountedApart) {
  MatchLog match(path(), session(), options());
  for (int i = 0; i < 5; ++i) match.truth(match.kick(1, "on_target"), "on_target", i < 2);
  match.truth(match.kick(1, "over"), "over", true);  // not inside: nobody asks
  match.kick(2, "on_target");                        // nobody said
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(row_of(report, "stopped").inside(), 5);
  EXPECT_EQ(row_of(report, "stopped").inside_kicks.bounced.truth, 5);
  EXPECT_EQ(row_of(report, "stopped").inside_kicks.bounced.truth_yes, 2);
  EXPECT_EQ(row_of(report, "stopped").inside_kicks.bounced.observed, 0);
  EXPECT_THAT(to_text(report),
              HasSubstr("bounced before the line, of those inside, by the simulator's truth: stopped 2 of 5\n"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("as observed")));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["policies"][0]["bounced"]["truth"]["bounced"], 2);
  EXPECT_TRUE(nlohmann::json::parse(to_json(report))["policies"][0]["bounced"]["observed"].is_null());
}

TEST_F(ReportOfALog, BlockedKicksStandApartWhereAsked) {
  MatchLog match(path(), session(), options());
  match.kicks(2, "on_target", 6);
  match.kicks(2, "blocked", 3);
  match.kicks(2, "over", 2);
  match.close();
  EXPECT_EQ(row_of(make_report(log::Reader(path())), "moving").outside(), 5);
  const Report apart = make_report(log::Reader(path()), true);
  const PolicyRow row = row_of(apart, "moving");
  EXPECT_EQ(row.outside(), 2);
  EXPECT_EQ(row.kicks(), 11);
  EXPECT_EQ(row.counts().n, 8);
  EXPECT_EQ(row.efficiency_bounds().lo, 0.75);
  EXPECT_THAT(to_text(apart), HasSubstr("blocked kicks stand apart"));
}

TEST_F(ReportOfALog, UnknownOutcomesBoundTheEfficiency) {
  MatchLog match(path(), session(), options());
  match.kicks(2, "on_target", 6);
  match.kicks(2, "bar", 2);
  match.kicks(2, "unknown", 1);
  const auto in_flight = match.decide(2);
  match.order(in_flight);
  match.receipt(in_flight);
  match.close();
  const Report report = make_report(log::Reader(path()));
  const auto row = row_of(report, "moving");
  EXPECT_EQ(row.unknown(), 2) << "an outcome that never came is unknown";
  EXPECT_EQ(row.counts().n, 8);
  EXPECT_NEAR(row.efficiency_bounds().lo, 0.6, 1e-15);
  EXPECT_NEAR(row.efficiency_bounds().hi, 0.8, 1e-15);
  EXPECT_THAT(to_text(report), HasSubstr("efficiency of moving: 60.0 % to 80.0 %, whatever the unknown kicks were\n"));
}

TEST_F(ReportOfALog, KicksThatMissAPartAreListed) {
  MatchLog match(path(), session(), options());
  match.kick(1, "over");
  const auto no_order = match.decide(1);
  const auto no_receipt = match.decide(1);
  match.order(no_receipt);
  const auto no_outcome = match.decide(1);
  match.order(no_outcome);
  match.receipt(no_outcome);
  match.close();
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.unclosed_kicks, SizeIs(3));
  EXPECT_EQ(report.unclosed_kicks[0].kick_id, no_order);
  EXPECT_FALSE(report.unclosed_kicks[0].has_order);
  EXPECT_TRUE(report.unclosed_kicks[1].has_order);
  EXPECT_FALSE(report.unclosed_kicks[1].has_receipt);
  EXPECT_TRUE(report.unclosed_kicks[2].has_receipt);
  EXPECT_FALSE(report.unclosed_kicks[2].has_outcome);
  EXPECT_THAT(to_text(report), HasSubstr("no order receipt outcome"));
  EXPECT_FALSE(report.data_lost()) << "the match may have ended in mid flight";
}

TEST_F(ReportOfALog, ARefusedOrderIsNoKick) {
  MatchLog match(path(), session(), options());
  match.kick(1, "on_target");
  const auto refused = match.decide(1);
  match.order(refused);
  match.receipt(refused, "stale");
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(row_of(report, "stopped").kicks(), 1);
  EXPECT_THAT(report.unclosed_kicks, IsEmpty()) << "there is nothing to wait for";
  ASSERT_THAT(report.refused_orders, SizeIs(1));
  EXPECT_EQ(report.refused_orders[0].refusal, "stale");
  EXPECT_THAT(to_text(report), HasSubstr("refused orders, no kicks: 1 x stale (stopped)"));
}

TEST_F(ReportOfALog, AnOrderThatWasAcceptedAndNotFiredIsCountedAmongTheRefused) {
  MatchLog match(path(), session(), options());
  const auto kick = match.decide(1);
  match.order(kick);
  match.receipt(kick, "none");
  match.receipt(kick, "fault");
  const auto refused = match.decide(1);
  match.order(refused);
  match.receipt(refused, "fault");
  match.close();
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.refused_orders, SizeIs(1));
  EXPECT_EQ(report.refused_orders[0].orders, 2);
  EXPECT_EQ(report.refused_orders[0].not_fired, 1);
  EXPECT_THAT(to_text(report),
              HasSubstr("refused orders, no kicks: 2 x fault (stopped); accepted at first and not fired: 1"));
}

TEST_F(ReportOfALog, AKickThatMayHaveBeenFiredCountsAndIsNamed) {
  MatchLog match(path(), session(), options());
  const auto kick = match.decide(1);
  match.order(kick);
  match.receipt(kick, "none");
  match.receipt(kick, "not_known");
  match.outcome(kick, "on_target");
  match.close();
  const Report report = make_report(log::Reader(path()));
  ASSERT_THAT(report.refused_orders, SizeIs(1));
  EXPECT_EQ(report.refused_orders[0].not_fired, 0);
  EXPECT_EQ(row_of(report, "stopped").kicks(), 1);
  EXPECT_THAT(to_text(report), HasSubstr("kicks that may not have been fired: 1 (stopped): the driver was killed while "
                                         "it wrote to the device"));
}

TEST_F(ReportOfALog, AnOrderSentTwiceIsOneAcceptedKick) {
  MatchLog match(path(), session(), options());
  const auto kick = match.kick(1, "on_target");
  match.order(kick);
  match.receipt(kick, "double");
  match.write_decision(kick, 1);
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(row_of(report, "stopped").inside(), 1);
  EXPECT_EQ(row_of(report, "stopped").kicks(), 1);
  EXPECT_THAT(report.refused_orders, IsEmpty());
}

TEST_F(ReportOfALog, KicksAMinuteUseThePlayedPartOfTheHalvesOfThePolicy) {
  MatchLog match(path(), session(), options());
  match.kicks(1, "on_target", 6);
  match.kicks(2, "over", 9);
  for (const int robot : {1, 2}) {  // both hear the same referee
    match.robot_id = robot;
    match.referee(0.0, 1, true);
    match.referee(60.0, 1, false);
    match.referee(90.0, 1, true);
    match.referee(150.0, 1, false);
    match.referee(200.0, 2, true);
    match.referee(230.0, 2, false);
  }
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_NEAR(*row_of(report, "stopped").played_min, 2.0, 1e-12);
  EXPECT_NEAR(*row_of(report, "stopped").kicks_per_min(), 3.0, 1e-12);
  EXPECT_NEAR(*row_of(report, "moving").kicks_per_min(), 18.0, 1e-12);
}

TEST_F(ReportOfALog, KicksOfRobotsWithTheSameNumberDoNotMix) {
  MatchLog match(path(), session(), options());
  const auto kick = match.decide(1);
  match.robot_id = 2;
  match.write_decision(kick, 1);
  match.outcome(kick, "on_target");
  match.robot_id = 1;
  match.outcome(kick, "over");
  match.close();
  const auto row = row_of(make_report(log::Reader(path())), "stopped");
  EXPECT_EQ(row.inside(), 1);
  EXPECT_EQ(row.of("over"), 1);
}

TEST_F(ReportOfALog, TheTruthIsComparedWhereBothAreKnown) {
  MatchLog match(path(), session(), options());
  match.truth(match.kick(1, "on_target"), "on_target");
  match.truth(match.kick(1, "post"), "on_target");
  match.truth(match.kick(1, "unknown"), "over");
  match.kick(1, "over");
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(report.compared_with_truth, 2);
  EXPECT_EQ(report.alike_with_truth, 1);
  const auto kicks = log::Reader(path()).kicks();
  ASSERT_THAT(kicks, SizeIs(4));
  EXPECT_EQ(kicks[1].observed->outcome, "post");
  EXPECT_EQ(kicks[1].truth->outcome, "on_target");
  EXPECT_EQ(kicks[1].truth->x_cross_m, 0.5);
  EXPECT_FALSE(kicks[3].truth);
  EXPECT_EQ(kicks[0].accepted, true);
}

TEST_F(ReportOfALog, SessionsOfAMergedFileArePooled) {
  for (const char* const name : {"match.db", "other.db"}) {
    auto of_its_own = session();
    of_its_own.seed = *name;  // with the same one it would be the same match
    MatchLog match(path(name), of_its_own, options());
    write_table2(match);
    match.close();
  }
  merge(path("other.db"), path());
  const Report report = make_report(log::Reader(path()));
  EXPECT_THAT(report.sessions, SizeIs(2));
  EXPECT_EQ(row_of(report, "stopped").inside(), 68);
  EXPECT_EQ(row_of(report, "moving").outside(), 64);
}

TEST_F(ReportOfALog, AnEmptyLogSaysThatThereAreNoKicks) {
  { log::Writer writer(path(), session(), options()); }
  const Report report = make_report(log::Reader(path()));
  EXPECT_FALSE(report.data_lost());
  EXPECT_THAT(to_text(report), HasSubstr("there are no kicks"));
  EXPECT_THAT(to_text(report), Not(HasSubstr("trivela compare")));
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["policies"][0]["inside"], 0) << "a policy without a kick is listed";
  EXPECT_TRUE(json["policies"][0]["efficiency"].is_null());
}

TEST_F(ReportOfALog, LostRowsAreShownByStreamAfterTheTable) {
  MatchLog match(path(), session(), options());
  match.kick(1, "on_target");
  match.writer().add_loss("world_states", log::LossKind::kGaps, 3);
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_TRUE(report.data_lost());
  EXPECT_EQ(report.rows_missing(), 3);
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("warning: world_states: 3 rows are missing"));
  EXPECT_LT(text.find("Table 2"), text.find("world_states"));
}

TEST_F(ReportOfALog, ASessionThatWasNotClosedCountsAsLoss) {
  MatchLog match(path(), session(), options());
  match.kick(1, "on_target");
  match.writer().flush();
  const Report report = make_report(log::Reader(path()));
  EXPECT_EQ(report.unclosed_sessions(), 1);
  EXPECT_TRUE(report.data_lost());
  EXPECT_EQ(row_of(report, "stopped").inside(), 1);
}

TEST_F(ReportOfALog, ARealMatchIsNotCalledSimulated) {
  auto real = session();
  real.simulated = false;
  real.seed.reset();
  MatchLog match(path(), real, options());
  match.kick(1, "on_target");
  match.close();
  const std::string text = to_text(make_report(log::Reader(path())));
  EXPECT_THAT(text, Not(HasSubstr("SIMULATED")));
  EXPECT_THAT(text, Not(HasSubstr("seed")));
}

}  // namespace
}  // namespace trivela::evaluator
