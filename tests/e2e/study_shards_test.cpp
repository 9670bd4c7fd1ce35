// Studies that are played in parts, as on the nodes of a cluster, or stopped and gone on with: the rows of one run.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Words = std::vector<std::string>;

const Words kFactorial{"study",  "factorial", "--matches",  "7", "--possessions", "4", "--opponent-median", "1,2",
                       "--jobs", "2",         "--eye-bias", "0"};
const Words kTune{
    "study",          "tune", "stopped",   "--matches",       "8",         "--possessions",     "4", "--rounds", "2",
    "--calibrations", "0",    "--setting", "policy.settle_s", "--setting", "policy.dribble_mps"};

struct Ran {
  int exit_code = 0;
  std::string output, errors;
};

Ran ran(const tests::Folder& folder, Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  Program program{"trivela", words, folder.path()};
  Ran result{.exit_code = program.wait(), .output = {}, .errors = {}};
  result.output = program.output();
  result.errors = program.errors();
  return result;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

/// The lines of a results file, which stand in any order.
std::vector<std::string> rows_of(const tests::Folder& folder, const std::string& file) {
  std::istringstream text{text_of(folder / file)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

/// The three shards of a study, put together in another order, have the rows of one run, and its report.
void expect_the_rows_of_one_run(const Words& study) {
  const tests::Folder folder;
  const Ran whole = ran(folder, study, {"--results", "whole.db", "--csv", "whole.csv"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  for (int shard = 1; shard <= 3; ++shard) {
    const Ran part =
        ran(folder, study, {"--shard", fmt::format("{}/3", shard), "--results", fmt::format("{}.db", shard)});
    ASSERT_EQ(part.exit_code, 0) << part.errors;
  }
  const Ran all = ran(folder, study, {"--results", "all.db", "--csv", "all.csv", "--with", "2.db", "3.db", "1.db"});
  EXPECT_EQ(all.output, whole.output) << all.errors;
  EXPECT_EQ(rows_of(folder, "all.db"), rows_of(folder, "whole.db"));
  EXPECT_EQ(text_of(folder / "all.csv"), text_of(folder / "whole.csv"));
  EXPECT_EQ(ran(folder, study, {}).output, whole.output) << "without a file of results";
  const Ran missing = ran(folder, study, {"--with", "3.db"});
  EXPECT_EQ(missing.output, whole.output) << "what no shard has is played";
}

TEST(StudyShards, OfAFactorialHaveTheRowsOfOneRun) { expect_the_rows_of_one_run(kFactorial); }

TEST(StudyShards, OfAFrontierWithCalibrationsHaveTheRowsOfOneRun) {
  expect_the_rows_of_one_run({"study", "frontier", "--matches", "5", "--possessions", "3", "--threshold", "0.2,0.6",
                              "--calibrations", "1", "--beside", "moving"});
}

TEST(StudyShards, OfASensitivityHaveTheRowsOfOneRun) {
  expect_the_rows_of_one_run({"study", "sensitivity", "--matches", "4", "--possessions", "3", "--arms",
                              "stopped,moving", "--input", "kicker.delay_s,policy.settle_s"});
}

TEST(StudyShards, OfArmsHaveTheRowsOfOneRun) {
  expect_the_rows_of_one_run({"study", "arms", "--arms", "stopped,moving", "--matches", "5", "--possessions", "6"});
}

TEST(StudyShards, OfATuneTakeTheSearchStepByStep) {
  const tests::Folder folder;
  Words with;
  int steps = 0;
  for (int exit_code = 3; exit_code == 3 && steps < 20; ++steps) {
    Words files{"--with"};
    for (int shard = 1; shard <= 2; ++shard) {
      files.push_back(fmt::format("{}_{}.db", steps, shard));
      Words more{"--shard", fmt::format("{}/2", shard), "--results", files.back()};
      more.insert(more.end(), with.begin(), with.end());
      const Ran part = ran(folder, kTune, more);
      exit_code = part.exit_code;
      ASSERT_TRUE(exit_code == 0 || exit_code == 3) << part.errors;
    }
    with = files;
  }
  ASSERT_GT(steps, 3);
  with.insert(with.end(), {"--results", "all.db", "--out", "best.toml"});
  ASSERT_EQ(ran(folder, kTune, with).exit_code, 0);
  const Ran whole = ran(folder, kTune, {"--results", "whole.db", "--out", "whole.toml"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_EQ(rows_of(folder, "all.db"), rows_of(folder, "whole.db"));
  EXPECT_EQ(text_of(folder / "best.toml"), text_of(folder / "whole.toml"));
}

TEST(StudyShards, ThatAreForeignOrSaySomethingElseAreNamed) {
  const tests::Folder folder;
  const Words study{"study", "arms", "--arms", "stopped", "--matches", "4", "--possessions", "3"};
  for (int shard = 1; shard <= 2; ++shard)
    ran(folder, study, {"--shard", fmt::format("{}/2", shard), "--results", fmt::format("{}.db", shard)});
  ran(folder, study, {"--seed", "2", "--results", "foreign.db"});
  const auto refusal = [&](const std::string& file) {
    const Ran all = ran(folder, study, {"--with", "1.db", file});
    EXPECT_EQ(all.exit_code, 1) << file;
    EXPECT_EQ(all.output, "") << file;
    return all.errors;
  };
  EXPECT_THAT(refusal("foreign.db"), HasSubstr("foreign.db: has results of another study"));
  EXPECT_THAT(refusal("nothing.db"), HasSubstr("nothing.db"));
  std::ofstream{folder / "changed.db"} << std::regex_replace(text_of(folder / "1.db"),
                                                             std::regex{"\n(\\w{16} 1 \\d+ \\d+) "}, "\n$1 7");
  EXPECT_THAT(refusal("changed.db"), HasSubstr("changed.db: says something else of match 1"));
  EXPECT_EQ(ran(folder, study, {"--with", "1.db", "2.db", "1.db"}).exit_code, 0)
      << "one that is there twice says nothing new";
  const Ran whole = ran(folder, study, {"--results", "whole.db", "--with", "1.db", "2.db"});
  const Ran again = ran(folder, study, {"--results", "whole.db", "--with", "whole.db", "1.db"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.output, whole.output) << "its own file, as a pattern of names gives it";
}

/// Stops a study of many matches when its file has some of them, by a signal.
Ran stopped(const tests::Folder& folder, const Words& study, const std::string& file) {
  Words words = study;
  words.insert(words.end(), {"--results", file});
  Program program{"trivela", words, folder.path()};
  EXPECT_TRUE(wait_for_change(folder.path(), program.watch(), [&] {
    std::error_code missing;  // of some 110 kB it has no match, of 260 kB all
    return std::filesystem::file_size(folder / file, missing) > 130'000 && !missing;
  }));
  program.signal(SIGINT);
  Ran result{.exit_code = program.wait(), .output = {}, .errors = program.errors()};
  return result;
}

TEST(StudyShards, OfArmsHaveTheCountsOfALogOfTheSameMatches) {
  const tests::Folder folder;
  const Words arms{"--arms", "stopped,moving@old", "--matches", "6", "--possessions", "8"};
  Words simulation{"simulate", "--out", "log.db"}, study{"study", "arms", "--results", "results.db", "--json"};
  simulation.insert(simulation.end(), arms.begin(), arms.end());
  study.insert(study.end(), arms.begin(), arms.end());
  ASSERT_EQ(ran(folder, simulation, {}).exit_code, 0);
  const Ran report = ran(folder, study, {});
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  const auto arms_in_report = nlohmann::json::parse(report.output).at("rows");
  SQLite::Database log((folder / "log.db").string());
  const auto in_log = [&](const std::string& arm, const std::string& rows) {
    return log.execAndGet("SELECT count(*) FROM sessions JOIN " + rows + " AND arm = '" + arm + "'").getInt64();
  };
  ASSERT_EQ(arms_in_report.size(), 2U);
  for (const auto& row : arms_in_report) {
    const std::string arm = row.at("arm");
    EXPECT_EQ(row.at("opportunities"), in_log(arm, "possession_truths USING (session_id) WHERE 1"));
    EXPECT_EQ(row.at("kicks"), in_log(arm, "kick_receipts USING (session_id) WHERE accepted = 1"));
    EXPECT_EQ(row.at("on_target"), in_log(arm, "kick_outcomes USING (session_id) WHERE on_target = 1"));
    EXPECT_GT(row.at("kicks"), 0);
  }
  for (const std::string verb : {"report", "compare", "merge"}) {
    Words words{verb};
    if (verb == "merge") words.push_back("out.db");
    const Ran refused = ran(folder, words, {"results.db"});
    EXPECT_EQ(refused.exit_code, 1) << verb;
    EXPECT_THAT(refused.errors, HasSubstr("results.db")) << verb;
  }
}

TEST(StudyShards, ThatAreStoppedKeepWhatTheyHaveAndGoOn) {
  const tests::Folder folder;
  const Words study{"study", "factorial", "--matches", "300", "--possessions", "6", "--no-sweep", "--jobs", "1"};
  const Ran first = stopped(folder, study, "results.db");
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.errors, HasSubstr("matches are in results.db: the same command goes on from there"));
  const auto kept = rows_of(folder, "results.db");
  const Ran again = ran(folder, study, {"--results", "results.db"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("matches are known already"));
  ASSERT_EQ(ran(folder, study, {"--results", "whole.db"}).exit_code, 0);
  const auto whole = rows_of(folder, "whole.db");
  EXPECT_LT(kept.size(), whole.size());
  EXPECT_EQ(rows_of(folder, "results.db"), whole);
  const Ran other = ran(folder, study, {"--results", "results.db", "--seed", "2"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("was begun with other arguments"));
}

TEST(StudyShards, SayWhatIsMissingBeforeTheyPlay) {
  const tests::Folder folder;
  const Ran without = ran(folder, kFactorial, {"--shard", "1/2"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.errors, HasSubstr("--results"));
  EXPECT_EQ(ran(folder, kFactorial, {"--shard", "1/2", "--results", "a.db", "--csv", "a.csv"}).exit_code, 2);
  EXPECT_EQ(ran(folder, kFactorial, {"--shard", "1/9", "--results", "a.db"}).exit_code, 2);
  EXPECT_EQ(ran(folder, kTune, {}).exit_code, 2);
  EXPECT_EQ(ran(folder, kFactorial, {"--results", "none/a.db"}).exit_code, 1);
  std::ofstream{folder / "other.db"} << "no results";
  const Ran other = ran(folder, kFactorial, {"--results", "other.db"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("other.db"));
  EXPECT_EQ(text_of(folder / "other.db"), "no results");
}

}  // namespace
}  // namespace trivela::e2e
