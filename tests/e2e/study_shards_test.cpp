// Studies that are played in parts, as on the nodes of a cluster, or stopped and gone on with: the rows of one run.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Words = std::vector<std::string>;

const Words kFactorial{"factorial", "--matches", "7", "--possessions", "4", "--opponent-median",
                       "1,2",       "--jobs",    "2", "--eye-bias",    "0"};
const Words kTune{
    "tune", "stopped",        "--matches", "8",         "--possessions",   "4",         "--rounds",
    "2",    "--calibrations", "0",         "--setting", "policy.settle_s", "--setting", "policy.dribble_mps"};

struct Ran {
  int exit_code = 0;
  std::string output, errors;
};

Ran ran(const Folder& folder, Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  Program program{"trivela", words, folder.path()};
  Ran result{.exit_code = program.wait(), .output = {}, .errors = {}};
  result.output = program.output();
  result.errors = program.errors();
  return result;
}

/// Every row of every table of a book, as text.
std::vector<std::string> book(const Folder& folder, const std::string& file) {
  SQLite::Database database((folder / file).string());
  std::vector<std::string> lines;
  for (const std::string table : {"studies", "arms", "tallies"}) {
    SQLite::Statement rows(database, "SELECT * FROM " + table);
    while (rows.executeStep()) {
      std::string line = table;
      for (int i = 0; i < rows.getColumnCount(); ++i) line += '|' + rows.getColumn(i).getString();
      lines.push_back(line);
    }
  }
  return lines;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

/// The three shards of a study, merged in another order, have the rows of one run, and its report.
void expect_the_rows_of_one_run(const Words& study) {
  const Folder folder;
  const Ran whole = ran(folder, study, {"--tallies", "whole.db", "--csv", "whole.csv"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  for (int shard = 1; shard <= 3; ++shard) {
    const Ran part =
        ran(folder, study, {"--shard", fmt::format("{}/3", shard), "--tallies", fmt::format("{}.db", shard)});
    ASSERT_EQ(part.exit_code, 0) << part.errors;
  }
  ASSERT_EQ(ran(folder, {"merge", "merged.db", "2.db", "3.db", "1.db"}, {}).exit_code, 0);
  EXPECT_EQ(book(folder, "merged.db"), book(folder, "whole.db"));
  const Ran merged = ran(folder, study, {"--tallies", "merged.db", "--csv", "merged.csv"});
  EXPECT_EQ(merged.output, whole.output);
  EXPECT_EQ(text_of(folder / "merged.csv"), text_of(folder / "whole.csv"));
  EXPECT_EQ(ran(folder, study, {}).output, whole.output) << "without a book";
}

TEST(StudyShards, OfAFactorialMergeToTheRowsOfOneRun) { expect_the_rows_of_one_run(kFactorial); }

TEST(StudyShards, OfAFrontierWithEveningsMergeToTheRowsOfOneRun) {
  expect_the_rows_of_one_run({"frontier", "--matches", "5", "--possessions", "3", "--threshold", "0.2,0.6",
                              "--calibrations", "1", "--beside", "moving"});
}

TEST(StudyShards, OfASensitivityMergeToTheRowsOfOneRun) {
  expect_the_rows_of_one_run({"sensitivity", "--matches", "4", "--possessions", "3", "--arms", "stopped,moving",
                              "--input", "kicker.delay_s,policy.settle_s"});
}

TEST(StudyShards, OfATuneTakeTheSearchStepByStep) {
  const Folder folder;
  Words after;
  int steps = 0;
  for (int exit_code = 3; exit_code == 3 && steps < 20; ++steps) {
    for (int shard = 1; shard <= 2; ++shard) {
      Words more{"--shard", fmt::format("{}/2", shard), "--tallies", fmt::format("{}.db", shard)};
      more.insert(more.end(), after.begin(), after.end());
      const Ran part = ran(folder, kTune, more);
      exit_code = part.exit_code;
      ASSERT_TRUE(exit_code == 0 || exit_code == 3) << part.errors;
    }
    if (exit_code == 0) break;
    after = {"--after", fmt::format("merged_{}.db", steps)};
    ASSERT_EQ(ran(folder, {"merge", after[1], "1.db", "2.db"}, {}).exit_code, 0);
  }
  ASSERT_GT(steps, 2);
  ASSERT_EQ(ran(folder, kTune, {"--tallies", after.at(1), "--out", "best.toml"}).exit_code, 0);
  const Ran whole = ran(folder, kTune, {"--tallies", "whole.db", "--out", "whole.toml"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_EQ(book(folder, after[1]), book(folder, "whole.db"));
  EXPECT_EQ(text_of(folder / "best.toml"), text_of(folder / "whole.toml"));
}

TEST(StudyShards, ThatLackAreTwiceOrForeignAreNamed) {
  const Folder folder;
  const auto play = [&](const std::string& file, const std::string& shard, const std::string& seed) {
    ASSERT_EQ(ran(folder, kFactorial, {"--no-sweep", "--seed", seed, "--shard", shard, "--tallies", file}).exit_code,
              0);
  };
  for (int shard = 1; shard <= 3; ++shard) play(fmt::format("{}.db", shard), fmt::format("{}/3", shard), "1");
  play("foreign.db", "2/3", "2");
  const auto refusal = [&](const Words& files) {
    Words words{"merge", "out.db"};
    words.insert(words.end(), files.begin(), files.end());
    const Ran merged = ran(folder, words, {});
    EXPECT_EQ(merged.exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.db"));
    return merged.errors;
  };
  EXPECT_THAT(refusal({"1.db", "3.db"}), HasSubstr("missing: 2/3"));
  std::filesystem::copy_file(folder / "2.db", folder / "again.db");
  EXPECT_THAT(refusal({"1.db", "2.db", "3.db", "again.db"}), AllOf(HasSubstr("again.db"), HasSubstr("2.db")));
  EXPECT_THAT(refusal({"1.db", "foreign.db", "3.db"}), AllOf(HasSubstr("foreign.db"), HasSubstr("another experiment")));
  EXPECT_THAT(refusal({"1.db", "2.db", "nothing.db"}), HasSubstr("nothing.db"));
  {
    SQLite::Database behind((folder / "2.db").string(), SQLite::OPEN_READWRITE);
    behind.exec("DELETE FROM tallies WHERE (arm_id, match_id) IN (SELECT arm_id, match_id FROM tallies LIMIT 1)");
  }
  EXPECT_THAT(refusal({"1.db", "2.db", "3.db"}), AllOf(HasSubstr("2.db"), HasSubstr("goes on from there")));
  play("2.db", "2/3", "1");
  EXPECT_EQ(ran(folder, {"merge", "out.db", "1.db", "2.db", "3.db"}, {}).exit_code, 0);
}

/// Stops a study of many matches when its book has some of them, by a signal.
Ran stopped(const Folder& folder, const Words& study, const std::string& book_file) {
  Words words = study;
  words.insert(words.end(), {"--tallies", book_file});
  Program program{"trivela", words, folder.path()};
  EXPECT_TRUE(wait_for_change(folder.path(), program.watch(), [&] {
    std::error_code missing;  // of some 110 kB it has no match, of 220 kB all
    return std::filesystem::file_size(folder / book_file, missing) > 130'000 && !missing;
  }));
  program.signal(SIGINT);
  Ran result{.exit_code = program.wait(), .output = {}, .errors = program.errors()};
  return result;
}

/// The counts of a match log's arms that a book of tallies keeps.
TEST(StudyShards, SummariesOfASimulationHaveTheCountsOfItsLog) {
  const Folder folder;
  const Words simulation{"simulate", "--arms", "stopped,moving@old", "--matches", "6", "--possessions", "8"};
  ASSERT_EQ(ran(folder, simulation, {"--out", "log.db"}).exit_code, 0);
  ASSERT_EQ(ran(folder, simulation, {"--out", "book.db", "--summaries"}).exit_code, 0);
  SQLite::Database log((folder / "log.db").string()), kept((folder / "book.db").string());
  const auto in_log = [&](const std::string& arm, const std::string& rows) {
    return log.execAndGet("SELECT count(*) FROM sessions JOIN " + rows + " AND arm = '" + arm + "'").getInt64();
  };
  for (const std::string arm : {"stopped", "moving@old"}) {
    const auto in_book = [&](const std::string& column) {
      return kept
          .execAndGet("SELECT sum(" + column + ") FROM tallies JOIN arms USING (arm_id) WHERE name = '" + arm + "'")
          .getInt64();
    };
    EXPECT_EQ(in_book("opportunities"), in_log(arm, "possession_truths USING (session_id) WHERE 1"));
    EXPECT_EQ(in_book("kicks"), in_log(arm, "kick_receipts USING (session_id) WHERE accepted = 1"));
    EXPECT_EQ(in_book("on_target"), in_log(arm, "kick_outcomes USING (session_id) WHERE on_target = 1"));
    EXPECT_GT(in_book("kicks"), 0);
  }
  const Ran report = ran(folder, {"report", "book.db"}, {});
  EXPECT_EQ(report.exit_code, 0);
  EXPECT_THAT(report.output, AllOf(HasSubstr("moving@old"), HasSubstr("SIMULATED"), HasSubstr("Not there")));
  const Ran compared = ran(folder, {"compare", "book.db", "--baseline", "moving@old"}, {});
  EXPECT_THAT(compared.output, HasSubstr("minus moving@old"));
  const Ran by_distance = ran(folder, {"compare", "book.db", "--stratify", "distance"}, {});
  EXPECT_EQ(by_distance.exit_code, 2);
  EXPECT_THAT(by_distance.errors, HasSubstr("sums of each arm's matches alone"));
  EXPECT_EQ(ran(folder, simulation, {"--out", "no.db", "--summaries", "--shadows"}).exit_code, 2);
}

TEST(StudyShards, OfSummariesMergeToTheRowsOfOneRun) {
  const Folder folder;
  const Words simulation{"simulate", "--arms", "stopped,moving", "--matches", "5", "--possessions", "6", "--summaries"};
  ASSERT_EQ(ran(folder, simulation, {"--out", "whole.db"}).exit_code, 0);
  for (const std::string shard : {"1", "2"})
    ASSERT_EQ(ran(folder, simulation, {"--out", shard + ".db", "--shard", shard + "/2"}).exit_code, 0);
  ASSERT_EQ(ran(folder, {"merge", "merged.db", "1.db", "2.db"}, {}).exit_code, 0);
  EXPECT_EQ(book(folder, "merged.db"), book(folder, "whole.db"));
}

TEST(StudyShards, ThatAreStoppedKeepWhatTheyHaveAndGoOn) {
  const Folder folder;
  const Words study{"factorial", "--matches", "300", "--possessions", "6", "--no-sweep", "--jobs", "1"};
  const Ran first = stopped(folder, study, "book.db");
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.errors, HasSubstr("matches are in book.db: the same command goes on from there"));
  const auto kept = book(folder, "book.db");
  const Ran again = ran(folder, study, {"--tallies", "book.db"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("matches are in book.db already"));
  ASSERT_EQ(ran(folder, study, {"--tallies", "whole.db"}).exit_code, 0);
  const auto whole = book(folder, "whole.db");
  EXPECT_LT(kept.size(), whole.size());
  EXPECT_EQ(book(folder, "book.db"), whole);
  const Ran other = ran(folder, study, {"--tallies", "book.db", "--seed", "2"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("was begun with other arguments"));
}

TEST(StudyShards, SayWhatIsMissingBeforeTheyPlay) {
  const Folder folder;
  const Ran without = ran(folder, kFactorial, {"--shard", "1/2"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.errors, HasSubstr("--tallies"));
  EXPECT_EQ(ran(folder, kFactorial, {"--shard", "1/2", "--tallies", "a.db", "--csv", "a.csv"}).exit_code, 2);
  EXPECT_EQ(ran(folder, kFactorial, {"--shard", "1/9", "--tallies", "a.db"}).exit_code, 2);
  EXPECT_EQ(ran(folder, kTune, {}).exit_code, 2);
  EXPECT_EQ(ran(folder, kFactorial, {"--tallies", "none/a.db"}).exit_code, 1);
  std::ofstream{folder / "other.db"} << "no book";
  const Ran other = ran(folder, kFactorial, {"--tallies", "other.db"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("other.db"));
  EXPECT_EQ(text_of(folder / "other.db"), "no book");
}

}  // namespace
}  // namespace trivela::e2e
