// What is counted of a session when it ends, beside what is counted of its rows when nobody did.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "evaluator/table2/table2.hpp"
#include "log/file/session_tallies.hpp"
#include "log/merge/merge.hpp"
#include "log/schema/row_digest.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using log::Check;
using log::Reader;
using testing::HasSubstr;

/// Views whose rows are tallies or counted now.
const std::vector<std::string> kViews{"played_possessions", "decided_possessions", "driver_counts", "recorded_halves"};

class SessionTallies : public LogTest {
 protected:
  void record() {
    MatchLog match(path(), session(), options());
    match.referee(0.0, 1, true);
    match.status(3, 1);
    match.kicks(1, "on_target", 4);
    match.status(5, 1);
    match.status(2, 1);  // the driver was started again
    match.referee(6.0, 1, false);
    match.referee(7.0, 2, true);
    match.kicks(2, "over", 3);
    match.decide(2);  // of which nothing follows
    match.referee(9.5, 2, false);
    match.close();
  }

  void exec(const std::string& sql) { SQLite::Database(path().string(), SQLite::OPEN_READWRITE).exec(sql); }

  std::vector<std::vector<log::Value>> rows(const std::string& view) {
    const Reader reader(path(), Check::kQuick);
    std::vector<std::vector<log::Value>> found;
    reader.query("SELECT * FROM " + view,
                 [&](std::span<const log::Value> row) { found.emplace_back(row.begin(), row.end()); });
    std::ranges::sort(found);
    return found;
  }

  std::int64_t number(const std::string& sql) { return SQLite::Database(path().string()).execAndGet(sql).getInt64(); }
};

TEST_F(SessionTallies, AreWrittenWhenASessionEnds) {
  record();
  EXPECT_EQ(number("SELECT count(*) FROM tallied_sessions JOIN digests USING (session_id, sha256)"), 1);
  EXPECT_EQ(number("SELECT decisions FROM session_tallies WHERE policy = 'stopped' AND in_charge = 1"), 4);
  EXPECT_EQ(number("SELECT fires FROM session_tallies WHERE policy = 'moving' AND in_charge = 1"), 4);
  EXPECT_EQ(number("SELECT count(*) FROM possession_tallies WHERE counted_by = 'robot'"), 8);
  EXPECT_EQ(number("SELECT sum(played_ns) FROM possession_tallies WHERE counted_by = 'referee'"), 8'500'000'000)
      << "6 s of the first half and 2.5 s of the second";
  EXPECT_EQ(number("SELECT first_handled FROM order_tallies"), 3);
  EXPECT_EQ(number("SELECT handled_within FROM order_tallies"), 4)
      << "2 more, and 2 since the driver was started again";
  EXPECT_EQ(number("SELECT last_t_ns FROM referee_tallies WHERE half = 2"), 9'500'000'000);
}

TEST_F(SessionTallies, SayWhatTheRowsSay) {
  record();
  const std::string tallied = to_json(make_report(Reader(path())));
  std::vector<std::vector<std::vector<log::Value>>> views;
  for (const std::string& view : kViews) views.push_back(rows(view));
  exec("DELETE FROM tallied_sessions");
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    EXPECT_FALSE(views[i].empty()) << kViews[i];
    EXPECT_EQ(rows(kViews[i]), views[i]) << kViews[i];
  }
  EXPECT_EQ(to_json(make_report(Reader(path()))), tallied);
}

TEST_F(SessionTallies, AreReadInPlaceOfTheRows) {
  record();
  exec("UPDATE order_tallies SET handled_within = 100");
  const Reader reader(path(), Check::kQuick);
  std::int64_t handled = 0;
  reader.query("SELECT handled_within FROM driver_counts", [&](std::int64_t n) { handled = n; });
  EXPECT_EQ(handled, 100);
}

TEST_F(SessionTallies, OfOtherRowsAreNotUsed) {
  record();
  exec("UPDATE order_tallies SET handled_within = 100; UPDATE tallied_sessions SET sha256 = 'of other rows'");
  const Reader reader(path(), Check::kQuick);
  std::int64_t handled = 0;
  reader.query("SELECT handled_within FROM driver_counts", [&](std::int64_t n) { handled = n; });
  EXPECT_EQ(handled, 4);
}

TEST_F(SessionTallies, ThatAreWrongAreNamedWhereRowsAreVerified) {
  for (const std::string change :
       {"session_tallies SET decisions = decisions + 1", "possession_tallies SET first_seq = 1 WHERE possession_id = 3",
        "order_tallies SET refused_within = 7", "referee_tallies SET words = 9"}) {
    std::filesystem::remove(path());
    record();
    exec("UPDATE " + change);
    try {
      const Reader reader(path(), Check::kWhole);
      ADD_FAILURE() << change;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(change.substr(0, change.find(' ')) + " of session")) << change;
    }
  }
  for (const std::string change : {"INSERT INTO ball_turns SELECT session_id, 0, 3.0 FROM sessions",
                                   "DELETE FROM possession_tallies WHERE possession_id = 2"}) {
    std::filesystem::remove(path());
    record();
    exec(change);
    EXPECT_THROW(Reader(path(), Check::kWhole), std::runtime_error) << change;
  }
}

TEST_F(SessionTallies, OfASessionThatNeverEndedAreNone) {
  record();
  exec("UPDATE sessions SET closed_t_ns = NULL; DELETE FROM digests; DELETE FROM tallied_sessions");
  for (const std::string& view : kViews) EXPECT_FALSE(rows(view).empty()) << view;
}

TEST_F(SessionTallies, OfAMergedLogAreThoseOfItsSessions) {
  record();
  const auto merged = path("merged.db");
  log::merge({path()}, merged);
  SQLite::Database database(merged.string());
  EXPECT_EQ(database.execAndGet("SELECT count(*) FROM tallied_sessions").getInt64(), 1);
  EXPECT_EQ(database.execAndGet("SELECT sum(decisions) FROM session_tallies").getInt64(), 8);
}

TEST_F(SessionTallies, HeldKicksAreThoseOfTheFile) {
  record();
  const Reader reader(path());
  const auto kicks = [&] {
    std::vector<std::vector<log::Value>> found;
    reader.query("SELECT * FROM kicks ORDER BY session_id, robot_id, kick_id",
                 [&](std::span<const log::Value> row) { found.emplace_back(row.begin(), row.end()); });
    return found;
  };
  const auto before = kicks();
  ASSERT_EQ(before.size(), 8u);
  reader.hold_kicks();
  EXPECT_EQ(kicks(), before);
}

}  // namespace
}  // namespace trivela::evaluator
