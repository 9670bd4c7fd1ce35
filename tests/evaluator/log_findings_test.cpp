// What `trivela doctor` says of logs, each with one thing wrong.
#include "evaluator/sessions/log_findings.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "log/merge/merge.hpp"
#include "log/schema/row_digest.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using Int = std::int64_t;
using Path = std::filesystem::path;

constexpr Int kSecond = 1'000'000'000;

class LogFindings : public LogTest {
 protected:
  Path sound(const std::string& name = "match.db") {
    MatchLog match(path(name), session(), options());
    match.kicks(1, "on_target", 3);
    match.close();
    return path(name);
  }

  static void exec(const Path& log, const std::string& sql) {
    SQLite::Database(log.string(), SQLite::OPEN_READWRITE).exec(sql);
  }

  /// Changes rows as a program would that wrote them so.
  static void rewrite(const Path& log, const std::string& sql) {
    SQLite::Database database(log.string(), SQLite::OPEN_READWRITE);
    database.exec(sql);
    log::RowDigests(database).write(database.execAndGet("SELECT session_id FROM sessions").getInt64());
  }

  static std::vector<LogFinding> wrong(const std::vector<LogFinding>& findings) {
    std::vector<LogFinding> wrong;
    std::ranges::copy_if(findings, std::back_inserter(wrong), [](const auto& f) { return f.health != Health::kOk; });
    return wrong;
  }

  /// The one thing that is wrong; a finding that is wrong always says what to do.
  static LogFinding only(const Path& log) {
    const auto found = wrong(examine_log(log));
    EXPECT_THAT(found, SizeIs(1));
    for (const LogFinding& one : found) EXPECT_NE(one.advice, "") << one.check << ": " << one.value;
    return found.empty() ? LogFinding{} : found.front();
  }

  static std::string bytes_of(const Path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(LogFindings, OfASoundLogSayThatEachCheckIsWell) {
  const std::string before = bytes_of(sound());
  std::vector<std::string> checks;
  for (const LogFinding& found : examine_log(path())) {
    EXPECT_EQ(found.health, Health::kOk) << found.check << ": " << found.value;
    EXPECT_EQ(found.advice, "");
    checks.push_back(found.check);
  }
  EXPECT_THAT(checks, testing::ElementsAre("file", "integrity", "-wal", "sessions", "rows", "silences", "orders",
                                           "length", "goal line", "release", "clock"));
  EXPECT_EQ(bytes_of(path()), before) << "it is only read";
}

TEST_F(LogFindings, AFileThatIsNoLogIsASentence) {
  EXPECT_THAT(only(path("nowhere.db")).value, HasSubstr("there is no match log"));
  std::ofstream(path("text.db")) << "kick, outcome\n1, goal\n";
  EXPECT_THAT(only(path("text.db")).value, HasSubstr("is not a match log"));
  std::ofstream(path("empty.db")).flush();
  EXPECT_EQ(only(path("empty.db")).health, Health::kBad);
  EXPECT_THAT(only(path("empty.db")).value, HasSubstr("is empty"));
  EXPECT_THAT(only(directory_).value, HasSubstr("is a folder"));
  sound();
  exec(path(), "PRAGMA user_version = 9");
  const LogFinding newer = only(path());
  EXPECT_THAT(newer.value, HasSubstr("of version 9; this program reads version 1 alone"));
  EXPECT_THAT(newer.advice, HasSubstr("that wrote it"));
}

TEST_F(LogFindings, ATruncatedLogIsDamagedAndMergeTakesWhatItCan) {
  sound();
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) / 2);
  const LogFinding found = only(path());
  EXPECT_EQ(found.health, Health::kBad);
  EXPECT_THAT(found.value, testing::AllOf(HasSubstr("damaged"), testing::Not(HasSubstr("trivela doctor"))));
  EXPECT_THAT(found.advice, HasSubstr("trivela merge"));
}

TEST_F(LogFindings, AChangedRowIsDamage) {
  sound();
  exec(path(), "UPDATE kick_outcomes SET outcome = 'over' WHERE kick_id = 1");
  EXPECT_THAT(only(path()).value, HasSubstr("are not those that were recorded"));
}

TEST_F(LogFindings, ASessionThatNeverEndedAndItsWalAreNamed) {
  MatchLog match(path(), session(), options());
  match.kicks(1, "on_target", 3);
  match.writer().flush();
  const auto found = wrong(examine_log(path()));
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].check, "-wal");
  EXPECT_THAT(found[0].value, HasSubstr("match.db-wal of"));
  EXPECT_THAT(found[1].value, AllOf(HasSubstr("robot 1"), HasSubstr("was never closed")));
}

TEST_F(LogFindings, LostRowsAndSilencesAreNamed) {
  MatchLog match(path(), session(), options());
  match.kicks(1, "on_target", 3);
  match.writer().silence({"odometry", 1, 12 * kSecond, 14 * kSecond});
  match.close();
  EXPECT_THAT(only(path()).value, HasSubstr("odometry of robot 1 silent"));
  rewrite(
      path(),
      "UPDATE losses SET gaps = 7, to_t_ns = 9 WHERE stream = 'kick_orders'; DELETE FROM losses WHERE robot_id = 1");
  EXPECT_EQ(only(path()).value, "kick_orders: 7 rows are missing");
}

TEST_F(LogFindings, OrdersThatAreInNoLogAreNamed) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  match.kicks(1, "on_target", 1);
  match.status(4, 0);
  match.close();
  EXPECT_EQ(only(path()).check, "orders");
}

TEST_F(LogFindings, AMatchThatWasCutShortIsNamed) {
  log::Session planned = session();
  planned.planned_s = 60.0;
  MatchLog match(path(), planned, options());
  match.referee(0.0, 1, true);
  match.kicks(1, "on_target", 1);
  match.referee(20.0, 1, false);
  match.close();
  const LogFinding found = only(path());
  EXPECT_EQ(found.check, "length");
  EXPECT_THAT(found.value, HasSubstr("cut short"));
}

TEST_F(LogFindings, AGoalThatTheBallsContradictIsNamed) {
  MatchLog match(path(), session(), options());
  const auto frames = match.writer().table(
      "flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"});
  Int seq = 0;
  for (int kick = 0; kick < 6; ++kick) {
    match.kick(1, "blocked");
    const Int release_t_ns = (4 * kick + 3) * 20'000'000;
    Int shown = 0;
    for (const double y_m : {5.0, 5.6, 6.2, 6.8, 7.0, 6.7, 6.4})
      match.writer().push(frames, {Int{1}, ++seq, Int{0}, release_t_ns + ++shown * 500'000, Int{1}, 0.0, y_m, 0.5});
  }
  match.close();
  const LogFinding found = only(path());
  EXPECT_EQ(found.check, "goal line");
  EXPECT_THAT(found.value, HasSubstr("balls came back from y = 7.00 m"));
}

TEST_F(LogFindings, AClockThatFellBackIsNamed) {
  MatchLog match(path(), session(), options());
  match.status(0, 0);
  match.status(0, 0);
  match.status(0, 0);
  match.close();
  EXPECT_THAT(wrong(examine_log(path())), SizeIs(0));
  rewrite(path(), "UPDATE kicker_status SET t_ns = t_ns + 5000000000 WHERE seq = 2");
  EXPECT_THAT(only(path()).value, HasSubstr("kicker_status of robot 1"));
  EXPECT_THAT(only(path()).value, HasSubstr("falls back 1 time, by up to 4.980 s"));
}

TEST_F(LogFindings, AClockThatJumpedWhileItWasMeasuredIsNamed) {
  sound();
  const std::string insert = "INSERT INTO clock_offsets SELECT session_id, 1, 2, ";
  rewrite(path(), insert + "10000000000, 5000000, 300000 FROM sessions");
  rewrite(path(), insert + "20000000000, 5100000, 300000 FROM sessions");
  EXPECT_THAT(wrong(examine_log(path())), SizeIs(0)) << "as clocks drift";
  rewrite(path(), insert + "30000000000, 905100000, 300000 FROM sessions");
  EXPECT_THAT(only(path()).value, HasSubstr("the clock of robot 2 jumped by 0.900 s against that of robot 1"));
}

TEST_F(LogFindings, UtcThatIsAnotherOneInTheSessionThatGoesOnIsNamed) {
  log::Session first = session();
  first.uuid = "11111111-2222-4333-8444-555555555555";
  first.simulated = first.simulated_clock = false;
  first.seed.reset();
  log::Session second = first;
  second.uuid = "22222222-2222-4333-8444-555555555555";
  second.continues_uuid = first.uuid;
  second.started_t_ns = 90 * kSecond;
  second.realtime_offset_ns = first.realtime_offset_ns + 3 * kSecond;
  {
    MatchLog one(path("one.db"), first, options());
    one.close();
  }
  {
    MatchLog two(path("two.db"), second, options());
    two.close();
  }
  log::merge({path("one.db"), path("two.db")}, path(), {});
  EXPECT_THAT(only(path()).value, HasSubstr("UTC jumped by +3.000 s"));
}

TEST_F(LogFindings, TalliesAreComparedWithTheRows) {
  sound();
  EXPECT_THAT(wrong(examine_log(path())), SizeIs(0));
  exec(path(), "UPDATE session_tallies SET fires = 2");
  EXPECT_EQ(only(path()).check, "file");
  EXPECT_THAT(only(path()).value, HasSubstr("does not count its rows"));
  EXPECT_EQ(only(path()).health, Health::kBad);
}

TEST_F(LogFindings, LogsThatSayDifferentThingsOfAKickAreNamed) {
  sound("a.db");
  std::filesystem::copy_file(path("a.db"), path("b.db"));
  EXPECT_THAT(wrong(compare_logs({path("a.db"), path("b.db")})), SizeIs(0));
  rewrite(path("b.db"), "UPDATE kick_outcomes SET outcome = 'bar' WHERE kick_id = 2");
  const auto found = wrong(compare_logs({path("a.db"), path("b.db"), path("nowhere.db")}));
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].value, "kick 1:2 (outcome): a.db says on_target, b.db says bar");
}

}  // namespace
}  // namespace trivela::evaluator
