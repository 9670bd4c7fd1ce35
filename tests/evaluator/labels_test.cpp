// What people say of kicks and sessions after the match.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdlib.h>
#include <time.h>

#include <fstream>

#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/counting/named_kicks.hpp"
#include "evaluator/learning/learned_fit.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "evaluator/table2/table2.hpp"
#include "log/merge/merge.hpp"
#include "log/write/additions.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using log::Additions;
using log::Check;
using log::Reader;
using testing::ElementsAre;
using testing::HasSubstr;
using Int = std::int64_t;

constexpr const char* kAfterFirst = "0000000-0000-4000-8000-000000000001";

class Labels : public LogTest {
 protected:
  /// Kicks 1 and 2 on target, 3 over, 4 unknown, 5 without a word of the observer; standing.
  std::filesystem::path match(const std::string& name = "match.db", char last = '1') {
    log::Session of = session();
    of.uuid = last + std::string(kAfterFirst);
    MatchLog match(path(name), of, options());
    match.kicks(1, "on_target", 2);
    match.kick(1, "over");
    match.kick(1, "unknown");
    const Int fifth = match.decide(1);
    match.order(fifth);
    match.receipt(fifth);
    match.close();
    return path(name);
  }

  static log::Label label(const NamedKick& kick, std::optional<std::string> outcome, const std::string& who = "Ada") {
    return {kick.session_id, kick.robot_id, kick.kick_id, kick.t_ns, std::move(outcome), who, ""};
  }

  void say(Int kick, std::optional<std::string> outcome, Int utc_ns = 1000, const std::string& who = "Ada",
           const std::string& name = "match.db") {
    const auto kicks = named_kicks(Reader(path(name)));
    Additions(path(name)).add(label(kick_called(kicks, std::to_string(kick), ""), std::move(outcome), who), utc_ns);
  }

  static PolicyRow standing(const std::filesystem::path& log) { return make_report(Reader(log)).policies.at(0); }

  std::string why_refused(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it was not refused";
  }

  Int number(const std::string& sql, const std::string& name = "match.db") {
    return SQLite::Database(path(name).string()).execAndGet(sql).getInt64();
  }
};

TEST_F(Labels, BeatTheObserverAndHisClassStays) {
  match();
  EXPECT_EQ(standing(path()).inside(), 2);
  EXPECT_EQ(standing(path()).unknown(), 2);
  say(1, "post");
  say(4, "on_target");
  say(5, "outside");
  const PolicyRow row = standing(path());
  EXPECT_EQ(row.inside(), 2);
  EXPECT_EQ(row.of("post"), 1);
  EXPECT_EQ(row.of("outside"), 1);
  EXPECT_EQ(row.unknown(), 0);
  EXPECT_EQ(number("SELECT count(*) FROM kick_outcomes WHERE outcome = 'on_target'"), 2) << "as the observer said";
}

TEST_F(Labels, TheLatestHolds) {
  match();
  say(4, "on_target", 1000);
  say(4, "over", 2000, "Grace");
  EXPECT_EQ(standing(path()).inside(), 2);
  EXPECT_EQ(standing(path()).of("over"), 2);
  EXPECT_EQ(number("SELECT count(*) FROM labels"), 2);
}

TEST_F(Labels, AWithdrawnOneGivesTheKickBackToTheObserver) {
  match();
  say(1, "over", 1000);
  EXPECT_EQ(standing(path()).inside(), 1);
  say(1, std::nullopt, 2000);
  EXPECT_EQ(standing(path()).inside(), 2);
  EXPECT_EQ(number("SELECT count(*) FROM labels"), 2) << "that it was withdrawn is a row, too";
}

TEST_F(Labels, ComeAfterEachOtherWhateverTheClockSays) {
  match();
  say(4, "on_target", 5000);
  say(4, "over", 10, "Grace");
  EXPECT_EQ(standing(path()).of("over"), 2);
  EXPECT_EQ(number("SELECT max(utc_ns) FROM labels"), 5001);
}

TEST_F(Labels, CountInCompareAndLearningToo) {
  match();
  say(1, "over");
  std::string by;
  int inside = 0;
  for (const auto& opportunity : read_log_kicks({path()}, {}, by).opportunities)
    inside += opportunity.ending == Ending::kInside ? 1 : 0;
  EXPECT_EQ(inside, 1);
  const Reader reader(path());
  reader.query("SELECT outcome FROM accepted_kicks WHERE kick_id = 1",
               [](const std::string& outcome) { EXPECT_EQ(outcome, "over"); });
}

TEST_F(Labels, AreCertain) {
  match();
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE kick_outcomes SET p_on_target = 0.6; DELETE FROM digests; UPDATE sessions SET closed_t_ns = NULL");
  EXPECT_NEAR(make_report(Reader(path())).labels.doubts.at(0).doubt.inside, 0.8, 1e-9);
  say(1, "on_target");
  EXPECT_NEAR(make_report(Reader(path())).labels.doubts.at(0).doubt.inside, 0.4, 1e-9);
}

TEST_F(Labels, LeaveTheDigestOfTheRowsAsItIs) {
  match();
  say(1, "over");
  Additions(path()).add(log::Note{Int{0}, "opponent", "Them", "Ada"}, 1);
  EXPECT_TRUE(Reader(path(), Check::kWhole).verification().compared);
}

TEST_F(Labels, TheReportSaysHowOftenTheyDisagreed) {
  match();
  EXPECT_THAT(to_text(make_report(Reader(path()))), testing::Not(HasSubstr("hand labels")));
  say(1, "on_target");
  say(2, "blocked");
  say(3, "outside");
  say(4, "over");
  const Report report = make_report(Reader(path()));
  EXPECT_EQ(report.hand_labels.kicks, 4);
  EXPECT_EQ(report.hand_labels.compared, 3);
  EXPECT_EQ(report.hand_labels.disagreed, 1) << "outside does not contradict over";
  EXPECT_EQ(report.hand_labels.observer_knew_not, 1);
  EXPECT_THAT(to_text(report),
              HasSubstr("hand labels: 4 kicks; they disagreed with the observer in 1 of 3, who did not know 1"));
  EXPECT_THAT(to_json(report), HasSubstr("\"disagreed\": 1"));
}

TEST_F(Labels, UnknownByHandIsUnknown) {
  match();
  say(1, "unknown");
  EXPECT_EQ(standing(path()).inside(), 1);
  EXPECT_EQ(standing(path()).unknown(), 3);
  EXPECT_EQ(make_report(Reader(path())).hand_labels.compared, 0);
}

TEST_F(Labels, HoldForTheKickInEveryRecordingOfIt) {
  match("a.db", '1');
  match("b.db", '2');
  say(1, "over", 1000, "Ada", "b.db");
  log::merge({path("a.db"), path("b.db")}, path("both.db"), {});
  const Report report = make_report(Reader(path("both.db")));
  EXPECT_EQ(report.policies.at(0).kicks(), 5) << "each once";
  EXPECT_EQ(report.policies.at(0).inside(), 1);
  EXPECT_EQ(report.hand_labels.kicks, 1);
}

TEST_F(Labels, OfACopyCountWhicheverLogComesFirst) {
  match("a.db");
  std::filesystem::copy_file(path("a.db"), path("b.db"));
  say(1, "saved", 1000, "Ada", "a.db");
  say(1, "over", 2000, "Ben", "b.db");
  say(2, "saved", 1000, "Ben", "b.db");
  for (const auto& [first, second] : {std::pair{"a.db", "b.db"}, std::pair{"b.db", "a.db"}}) {
    Reader one(path(first)), other(path(second));
    const std::array logs{OpenLog{&one, first}, OpenLog{&other, second}};
    const Report report = make_report(logs);
    EXPECT_EQ(report.policies.at(0).inside(), 1) << first;
    EXPECT_EQ(report.policies.at(0).inside_kicks.saved.observed_yes, 1) << first;
    std::string by;
    int saved = 0;
    for (const auto& o : read_log_kicks({path(first), path(second)}, {}, by).opportunities)
      saved += o.ending == Ending::kInside && o.saved.value_or(false) ? 1 : 0;
    EXPECT_EQ(saved, 1) << first;
  }
}

TEST_F(Labels, SayGoalOrSavedOfAKickOnTarget) {
  match();
  EXPECT_FALSE(make_report(Reader(path())).keeper());
  say(1, "goal");
  say(2, "saved");
  say(4, "on_target");
  const Report report = make_report(Reader(path()));
  const PolicyRow& row = report.policies.at(0);
  EXPECT_EQ(row.inside(), 3);
  EXPECT_EQ(row.goals(), 1);
  EXPECT_EQ(row.inside_kicks.saved.observed_yes, 1);
  EXPECT_TRUE(report.keeper());
  EXPECT_THAT(to_json(report), HasSubstr("\"goal_not_known\": 1"));
  say(1, std::nullopt, 2000);
  EXPECT_EQ(make_report(Reader(path())).policies.at(0).goals(), 0) << "the observer had not said it";
}

TEST(HandLabel, ContradictsWhatTheObserverSaysOfTheKeeper) {
  EXPECT_TRUE(disagree("goal", "saved"));
  EXPECT_TRUE(disagree("saved", "goal"));
  EXPECT_FALSE(disagree("saved", "on_target"));
  EXPECT_FALSE(disagree("on_target", "goal"));
  EXPECT_TRUE(disagree("saved", "over"));
  EXPECT_TRUE(disagree("outside", "goal"));
  EXPECT_FALSE(disagree("outside", "over"));
}

TEST_F(Labels, DecideWhichOfTwoLogsCounts) {
  match("a.db", '1');
  match("b.db", '2');
  say(1, "over", 1000, "Ada", "b.db");
  say(2, "bar", 1000, "Ada", "a.db");
  std::string by;
  int inside = 0;
  for (const auto& o : read_log_kicks({path("a.db"), path("b.db")}, {}, by).opportunities)
    inside += o.ending == Ending::kInside ? 1 : 0;
  EXPECT_EQ(inside, 0);
}

TEST_F(Labels, WhatIsNoneIsRefusedAndNothingIsAdded) {
  match();
  Additions additions(path());
  const auto kicks = named_kicks(Reader(path()));
  const auto refused = [&](const log::Label& wrong) { return why_refused([&] { additions.add(wrong, 1000); }); };
  EXPECT_THAT(refused(label(kicks[0], "in")), HasSubstr("'in' is none of on_target, wide_left"));
  EXPECT_THAT(refused(label(kicks[0], "own_half")), HasSubstr("is none of"));
  EXPECT_THAT(refused(label(kicks[0], "over", " ")), HasSubstr("somebody must say so"));
  EXPECT_THAT(refused(label(kicks[0], "over", std::string(201, 'a'))), HasSubstr("201 bytes"));
  EXPECT_THAT(refused(label(kicks[0], "over", "A\xff")), HasSubstr("UTF-8"));
  EXPECT_THAT(refused(label(kicks[0], "over", std::string("A\0b", 3))), HasSubstr("UTF-8"));
  EXPECT_EQ(number("SELECT count(*) FROM labels"), 0);
}

TEST_F(Labels, OfAnotherVersionAreRefused) {
  match();
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 9");
  EXPECT_THAT(why_refused([&] { Additions{path()}; }), HasSubstr("this program reads version 1 alone"));
  std::ofstream(path("none.db")) << "no log";
  EXPECT_THAT(why_refused([&] { Additions{path("none.db")}; }), HasSubstr("is not a match log"));
}

TEST_F(Labels, TriggersOfTheFileAreNotRun) {
  match();
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE)
      .exec("CREATE TRIGGER t AFTER INSERT ON labels BEGIN DELETE FROM kick_outcomes; END");
  say(1, "over");
  EXPECT_EQ(number("SELECT count(*) FROM kick_outcomes"), 4);
}

TEST_F(Labels, MayBeAddedWhileARecorderIsAtWork) {
  MatchLog running(path(), session(), options());
  running.kicks(1, "on_target", 2);
  running.writer().flush();
  say(1, "over");
  running.kicks(1, "on_target", 1);
  running.close();
  EXPECT_EQ(standing(path()).inside(), 2);
  EXPECT_TRUE(Reader(path(), Check::kWhole).verification().compared);
}

TEST_F(Labels, KicksAreCalledByRobotAndNumber) {
  match();
  const auto kicks = named_kicks(Reader(path()));
  EXPECT_EQ(kick_called(kicks, "1:3", "").kick_id, 3);
  EXPECT_EQ(kick_called(kicks, "3", "").kick_id, 3);
  EXPECT_EQ(kick_called(kicks, "1:3", "10000000").kick_id, 3);
  EXPECT_TRUE(kick_called(kicks, "4", "").unknown());
  const auto refused = [&](const std::string& name, const std::string& of) {
    return why_refused([&] { kick_called(kicks, name, of); });
  };
  EXPECT_THAT(refused("9", ""), HasSubstr("there is no kick 9; the first of 5 is 1:1 at"));
  EXPECT_THAT(refused("2:1", ""), HasSubstr("there is no kick 2:1"));
  EXPECT_THAT(refused("1:3", "ffff"), HasSubstr("in a session ffff"));
  for (const char* const wrong : {"", "one", "1:", ":1", "1:2:3", "-1", "99999999999999999999"})
    EXPECT_THAT(refused(wrong, ""), HasSubstr("is no kick: say ROBOT:NUMBER")) << wrong;
}

TEST_F(Labels, AKickThatCouldBeSeveralIsAskedFor) {
  log::Session of = session();
  {
    MatchLog first(path("a.db"), of, options());
    first.kick(1, "over");
    first.close();
    MatchLog second(path("b.db"), of, options());
    second.y_m = 3.0;
    second.referee(0.0, 1, true);  // so that the kick has another instant
    second.kick(1, "over");
    second.close();
  }
  log::merge({path("a.db"), path("b.db")}, path("both.db"), {});
  const auto kicks = named_kicks(Reader(path("both.db")));
  EXPECT_THAT(why_refused([&] { kick_called(kicks, "1:1", ""); }), HasSubstr("may be one of 2"));
  EXPECT_EQ(kick_called(kicks, "1:1", kicks.at(1).uuid).t_ns, kicks[1].t_ns);
}

using Notes = Labels;

TEST_F(Notes, OfMatchOpponentAndVenueTheLatestHolds) {
  match();
  const Int of = number("SELECT session_id FROM sessions");
  Additions additions(path());
  additions.add(log::Note{of, "opponent", "Others", "Ada"}, 1000);
  additions.add(log::Note{of, "opponent", "Them", "Ada"}, 1000);
  additions.add(log::Note{of, "note", "a post leans", "Ada"}, 1'000'000'000);
  additions.add(log::Note{of, "note", "rain", "Grace"}, 2'000'000'000);
  additions.add(log::Note{of, "match", "semi-final", "Ada"}, 1000);
  additions.add(log::Note{of, "venue", "Hall 3", "Ada"}, 1000);
  additions.add(log::Note{of, "venue", std::nullopt, "Ada"}, 2000);
  ::setenv("TZ", "Asia/Tokyo", 1);  // UTC wherever it is read
  ::tzset();
  std::vector<std::string> lines;
  for (const SessionNote& note : make_report(Reader(path())).notes) lines.push_back(line_of(note));
  ::unsetenv("TZ");
  ::tzset();
  EXPECT_THAT(lines,
              ElementsAre("Match: semi-final", "Opponent: Them", "Note of Ada, 1970-01-01 00:00 UTC: a post leans",
                          "Note of Grace, 1970-01-01 00:00 UTC: rain"));
  EXPECT_EQ(session_notes(Reader(path())).size(), 7u);
  additions.add(log::Note{of, "note", std::nullopt, "Ada"}, 3'000'000'000);
  EXPECT_EQ(make_report(Reader(path())).notes.size(), 2u);
}

TEST_F(Notes, OfNobodyOrOfAnotherKindAreRefused) {
  match();
  Additions additions(path());
  EXPECT_THAT(why_refused([&] {
                additions.add(log::Note{1, "weather", "wet", "Ada"}, 1);
              }),
              HasSubstr("'weather' is none of match, opponent, venue, note"));
  EXPECT_THAT(why_refused([&] { additions.add(log::Note{1, "note", "wet", ""}, 1); }), HasSubstr("somebody"));
  EXPECT_EQ(number("SELECT count(*) FROM notes"), 0);
}

}  // namespace
}  // namespace trivela::evaluator
