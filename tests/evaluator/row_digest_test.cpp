// The digest of a session's rows.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "evaluator/table2/table2.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::Check;
using log::Reader;
using log::RowDigest;
using testing::HasSubstr;

class DigestOfRows : public LogTest {
 protected:
  void record() {
    log::Session session = LogTest::session();
    session.uuid = "01234567-89ab-4cde-8f01-23456789abcd";
    MatchLog match(path(), session, options());
    match.kick(1, "on_target");
    match.truth(match.kick(2, "over"), "over");
    match.close();
  }

  static RowDigest noted(const std::filesystem::path& path) {
    SQLite::Database database(path.string());
    SQLite::Statement query(database, "SELECT row_count, sha256 FROM digests");
    if (!query.executeStep()) return {};
    return {query.getColumn(0).getInt64(), query.getColumn(1).getString()};
  }

  std::int64_t number(const std::string& sql) const {
    return SQLite::Database(path().string()).execAndGet(sql).getInt64();
  }

  RowDigest now() {
    SQLite::Database database(path().string());
    return log::RowDigests(database).of(number("SELECT session_id FROM sessions"));
  }

  void exec(const std::string& sql) { SQLite::Database(path().string(), SQLite::OPEN_READWRITE).exec(sql); }
};

TEST_F(DigestOfRows, IsWhatItsDefinitionSays) {
  record();
  EXPECT_EQ(noted(path()), now());
  EXPECT_EQ(now().row_count, 19);
  EXPECT_EQ(now().sha256, "5fa2c1c0f613dd678096558ce1244ef6cc5cc9951e01c1fb072f8df41a55577c")
      << "another definition is another version of the log";
}

TEST_F(DigestOfRows, TellsCellsApart) {
  record();
  std::set<std::string> digests{now().sha256};
  for (const char* const change :
       {"kicker_table = NULL", "kicker_table = ''", "kicker_table = '1'", "match_id = 1", "match_id = 0", "seed = NULL",
        "arm = '1', kicker_table = NULL", "arm = '1x', kicker_table = 'y'", "arm = '1', kicker_table = 'xy'"}) {
    exec(std::string("UPDATE sessions SET ") + change);
    digests.insert(now().sha256);
  }
  EXPECT_EQ(digests.size(), 9u) << "the first change is none";
  exec("UPDATE kick_outcomes SET exit_speed_mps = 1");
  const std::string one = now().sha256;
  exec("UPDATE kick_outcomes SET exit_speed_mps = -1");
  EXPECT_NE(now().sha256, one);
}

TEST_F(DigestOfRows, CoversEveryTableOfSessionsButItself) {
  record();
  SQLite::Database database(path().string());
  std::set<std::string> covered;
  for (const auto& table : log::digested_tables()) covered.insert(table.name);
  for (const std::string& table : log::tables_of(database)) {
    if (table == "digests" || table.starts_with("sqlite_")) continue;
    if (std::ranges::find(log::kSaidAfterwards, table) != log::kSaidAfterwards.end()) continue;
    if (std::ranges::find(log::kTallies, table) != log::kTallies.end()) continue;
    const auto columns = *log::columns_of(database, table);
    if (std::ranges::find(columns, "session_id", &log::Column::name) == columns.end()) continue;
    EXPECT_TRUE(covered.contains(table)) << table;
  }
}

TEST_F(DigestOfRows, LeavesOutWhatIsSaidAfterwards) {
  record();
  const RowDigest before = now();
  exec(
      "INSERT INTO session_clocks VALUES (1, 0, 0, 0.0, 0, 'other');"
      "INSERT INTO merged_sessions VALUES (1, 'match.db', 1, '');"
      "INSERT INTO labels VALUES (1, 1, 1, 5, 'Ada', 0, 'on_target', ''), (1, 1, 1, 6, 'Ada', 0, NULL, 'the video');"
      "INSERT INTO notes VALUES (1, 'opponent', 5, 'Ada', 'them');"
      "INSERT INTO session_tallies VALUES (1, 1, 'moving', 1, 2, 1, 0, 9, 1);"
      "INSERT INTO possession_tallies VALUES (1, 1, 1, 1, 'robot', 1, 2, 1, 0, 9, 9);"
      "INSERT INTO order_tallies VALUES (1, 1, 0, 0, 0, 1, 0);");
  for (const std::string_view table : log::kSaidAfterwards)
    EXPECT_GT(number("SELECT count(*) FROM " + std::string(table)), 0) << table;
  EXPECT_EQ(now(), before);
}

TEST_F(DigestOfRows, AnExperimentHasOneForEachSession) {
  {
    TestExperiment experiment{path(), 2};
    for (std::uint32_t match = 0; match < 2; ++match) {
      experiment.begin();
      for (std::uint32_t arm = 0; arm < 2; ++arm) {
        experiment.session(match, arm, "arm" + std::to_string(arm), {});
        experiment.possession(1, 1, "moving", 0.5, std::nullopt);
      }
      experiment.commit();
    }
    experiment.finish();
  }
  EXPECT_EQ(number("SELECT count(*) FROM digests JOIN sessions USING (session_id)"), 4);
  EXPECT_TRUE(Reader(path(), Check::kWhole).verification().compared);
}

TEST_F(DigestOfRows, ASessionThatNeverEndedHasNone) {
  log::Writer writer(path(), session(), options());
  writer.push(referee_table(writer), referee_row(1));
  writer.flush();
  const Reader reader(path());
  EXPECT_THAT(reader.doubt().value_or(""), HasSubstr("not verified: a session that never ended"));
}

}  // namespace
}  // namespace trivela::evaluator
