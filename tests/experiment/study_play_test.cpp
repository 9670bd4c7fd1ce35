// The engine of every study: what is known is not played again, and parts make the rows of one run.
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "experiment/run/arms.hpp"
#include "experiment/study/studies.hpp"
#include "log/file/new_file.hpp"
#include "play_arms.hpp"
#include "tests/support/folder.hpp"

namespace trivela::experiment {
namespace {

using log::StudyResults;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr const char* kArguments = "seed = 3\n";
const PlayPlan kPlan{.seed = 3, .matches = 4, .possessions = 4, .jobs = 2};

Arm arm_called(const std::string& name, kicking::PolicyName policy) {
  Arm made;
  made.name = name;
  made.policy = policy;
  return made;
}

std::vector<Arm> stopped_and_moving() {
  return {arm_called("stopped", kicking::PolicyName::kStopped), arm_called("moving", kicking::PolicyName::kMoving)};
}

/// What is known after one world was played.
struct Played {
  std::vector<ArmTally> arms;
  bool whole = false;
  std::size_t missing = 0;  ///< matches that had to be played
};

Played play_world(StudyResults& results, const PlayPlan& plan = kPlan,
                  const std::vector<Arm>& arms = stopped_and_moving(), const sim::Scenario& scenario = {}) {
  std::size_t missing = 0;
  const auto told = [&](std::size_t, std::size_t all, const std::string&) { missing = all; };
  const KnownPlay known = play_missing({{"test", scenario, arms}}, plan, results, told);
  results.commit();
  return {tallies_of(known.rows), known.whole, missing};
}

PlayPlan shard_of(std::uint32_t number, std::uint32_t count) {
  PlayPlan plan = kPlan;
  plan.shard = log::Shard{number, count};
  return plan;
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

/// The matches of one run without a file.
std::vector<ArmTally> of_one_run() {
  StudyResults results{"", kArguments};
  return play_world(results).arms;
}

TEST(StudyPlay, TheMatchesOfAFileAreNotPlayedAgain) {
  const tests::Folder folder;
  {
    StudyResults results{folder / "a.db", kArguments};
    EXPECT_EQ(play_world(results, shard_of(1, 2)).missing, 4u);
  }
  StudyResults results{folder / "a.db", kArguments};
  EXPECT_EQ(results.size(), 4U);
  const Played rest = play_world(results);
  EXPECT_EQ(rest.missing, 4u);
  EXPECT_TRUE(rest.whole);
  EXPECT_EQ(rest.arms, of_one_run());
  EXPECT_EQ(play_world(results).missing, 0u);
}

TEST(StudyPlay, AShardPlaysItsOwnMatchesAndIsNotTheWhole) {
  StudyResults results{"", kArguments};
  const Played part = play_world(results, shard_of(2, 3));
  EXPECT_EQ(part.missing, 2u);
  EXPECT_FALSE(part.whole);
  const auto all = of_one_run();
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(part.arms[i][0], MatchTally{});
    EXPECT_EQ(part.arms[i][1], all[i][1]);
    EXPECT_EQ(part.arms[i][2], MatchTally{});
    EXPECT_EQ(part.arms[i][3], MatchTally{});
  }
}

TEST(StudyPlay, ShardsInAnyOrderAreTheRowsOfOneRun) {
  const tests::Folder folder;
  for (const std::uint32_t shard : {1u, 2u}) {
    StudyResults results{folder / std::to_string(shard), kArguments};
    play_world(results, shard_of(shard, 2));
  }
  StudyResults all{"", kArguments};
  for (const char* const shard : {"2", "1", "2"}) all.take_over(folder / shard);
  const Played put_together = play_world(all);
  EXPECT_EQ(put_together.missing, 0u);
  EXPECT_TRUE(put_together.whole);
  EXPECT_EQ(put_together.arms, of_one_run());
}

TEST(StudyPlay, ResultsInMemoryAreSavedAsAFileThatGoesOn) {
  const tests::Folder folder;
  {
    StudyResults results{"", kArguments};
    play_world(results, shard_of(1, 2));
    results.save(folder / "a.db");
  }
  StudyResults results{folder / "a.db", kArguments};
  EXPECT_EQ(play_world(results).missing, 4u);
}

TEST(StudyPlay, AnArmThatIsThereTwiceIsPlayedOnceAndCountsTwice) {
  std::vector<Arm> arms = stopped_and_moving();
  arms.push_back(arms.front());
  StudyResults results{"", kArguments};
  const Played once = play_world(results, kPlan, arms);
  EXPECT_EQ(once.missing, 8u);
  EXPECT_EQ(once.arms[2], once.arms[0]);
  EXPECT_TRUE(once.whole);
}

TEST(StudyPlay, WorldsArePlayedTogetherAndTheirRowsComeInTheirOrder) {
  sim::Scenario kept;
  kept.keeper.enabled = true;
  const RowLabels first{{"world", "open"}}, second{{"world", "kept"}};
  const std::vector<StudyWorld> worlds{{"open", {}, {stopped_and_moving()[0]}, {first}},
                                       {"kept", kept, {stopped_and_moving()[0]}, {second}},
                                       {"open again", {}, {stopped_and_moving()[0]}, {first}}};
  StudyResults results{"", kArguments};
  std::vector<std::string> told;
  const KnownPlay known = play_missing(
      worlds, kPlan, results, [&](std::size_t, std::size_t, const std::string& what) { told.push_back(what); });
  EXPECT_EQ(told.size(), 1u + 8u) << "the third world has no match of its own";
  ASSERT_EQ(known.rows.size(), 3u);
  EXPECT_EQ(known.rows[1].label("world"), "kept");
  EXPECT_EQ(known.rows[0].matches, of_one_run()[0]);
  EXPECT_EQ(known.rows[2].matches, known.rows[0].matches);
}

TEST(StudyPlay, NoMatchStandsForOneOfAnotherSeedLengthOrWorld) {
  StudyResults results{"", kArguments};
  play_world(results);
  PlayPlan other = kPlan;
  other.seed = 4;
  EXPECT_EQ(play_world(results, other).missing, 8u);
  other = kPlan;
  other.possessions = 5;
  EXPECT_EQ(play_world(results, other).missing, 8u);
  sim::Scenario world;
  world.keeper.enabled = !world.keeper.enabled;
  EXPECT_EQ(play_world(results, kPlan, stopped_and_moving(), world).missing, 8u);
}

TEST(StudyPlay, OtherCalibrationsAreOtherMatchesButForAnArmWithRobotsOfItsOwn) {
  std::vector<Arm> arms = stopped_and_moving();
  arms[1].own_robots = true;
  StudyResults results{"", kArguments};
  play_world(results, kPlan, arms);
  PlayPlan calibrated = kPlan;
  config::Robot late;
  late.model.delay_s = 0.09;
  calibrated.calibrations = {{config::Robot{}}, {late}};
  const Played again = play_world(results, calibrated, arms);
  EXPECT_EQ(again.missing, 4u) << "those of the first arm";
  EXPECT_EQ(again.arms[0][0].calibration, 0u);
  EXPECT_EQ(again.arms[0][3].calibration, 1u);
}

TEST(StudyPlay, WhereItIsStoppedTheFileHasWhatWasReportedAndNoMore) {
  const tests::Folder folder;
  struct Enough {};
  {
    StudyResults results{folder / "a.db", kArguments};
    const auto stop = [](std::size_t done, std::size_t, const std::string&) {
      if (done == 3) throw Enough{};
    };
    EXPECT_THROW(play_missing({{"test", {}, stopped_and_moving()}}, kPlan, results, stop), Enough);
    results.commit();
  }
  StudyResults results{folder / "a.db", kArguments};
  EXPECT_EQ(results.size(), 3U);
  EXPECT_EQ(play_world(results).arms, of_one_run());
}

TEST(StudyPlay, AFileOfOtherArgumentsIsRefusedWithTheLineThatDiffers) {
  const tests::Folder folder;
  { const StudyResults begun{folder / "a.db", "seed = 3\npossessions = 4\n"}; }
  EXPECT_THAT([&] { StudyResults(folder / "a.db", "seed = 3\npossessions = 5\n"); },
              ThrowsMessage<log::FileTaken>(
                  AllOf(HasSubstr("a.db"), HasSubstr("possessions = 4"), HasSubstr("possessions = 5"))));
  std::ofstream{folder / "text.db"} << "kick, outcome\n1, goal\n, and so on for more than a page of a database\n";
  EXPECT_THAT([&] { StudyResults(folder / "text.db", kArguments); },
              ThrowsMessage<log::FileTaken>(HasSubstr("text.db: is there already and has no study results")));
}

TEST(StudyPlay, AFileThatAnotherRunWritesToIsRefused) {
  const tests::Folder folder;
  const StudyResults first{folder / "a.db", kArguments};
  EXPECT_THAT([&] { StudyResults(folder / "a.db", kArguments); },
              ThrowsMessage<log::FileTaken>(HasSubstr("a.db: another run writes to it")));
}

TEST(StudyPlay, AFileThatWasCutOffGoesOnFromItsLastWholeLine) {
  const tests::Folder folder;
  {
    StudyResults results{folder / "a.db", kArguments};
    play_world(results);
  }
  const std::string whole = text_of(folder / "a.db");
  for (const auto& [bytes, missing] : {std::pair{whole.size() - 3, 1U}, std::pair{std::size_t{9}, 8U}}) {
    std::ofstream{folder / "a.db"} << whole.substr(0, bytes);
    StudyResults results{folder / "a.db", kArguments};
    EXPECT_EQ(play_world(results).missing, missing);
    EXPECT_EQ(text_of(folder / "a.db").size(), whole.size());
  }
  std::ofstream{folder / "a.db"} << whole << "no match\n";
  EXPECT_THAT([&] { StudyResults(folder / "a.db", kArguments); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a.db: is damaged: no match")));
}

TEST(StudyPlay, AForeignShardAndOneThatSaysSomethingElseLeaveTheResultsAsTheyAre) {
  const tests::Folder folder;
  for (const auto& [name, arguments] : {std::pair{"ours.db", kArguments}, std::pair{"foreign.db", "seed = 4\n"}}) {
    StudyResults results{folder / name, arguments};
    play_world(results, shard_of(1, 2));
    results.commit();
  }
  const std::string more =
      std::regex_replace(text_of(folder / "ours.db"), std::regex{"\n(\\w{16} 1 \\d+ \\d+) "}, "\n$1 7");
  std::ofstream{folder / "changed.db"} << std::regex_replace(more, std::regex{"\n(\\w{16}) 0 "}, "\n$1 3 ");
  StudyResults all{"", kArguments};
  all.take_over(folder / "ours.db");
  EXPECT_THAT([&] { all.take_over(folder / "foreign.db"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("foreign.db: has results of another study")));
  EXPECT_THAT([&] { all.take_over(folder / "changed.db"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("changed.db: says something else of match 1")));
  EXPECT_EQ(all.size(), 4U) << "match 3 of the changed one is not taken either";
}

TEST(StudyPlay, ArgumentsOfAStudyNameWhatEachWorldHasOfItsOwn) {
  const config::NamedWorld usual{"as it is", "", {}};
  config::NamedWorld slow{"slow", "", {}};
  slow.scenario.keeper.guard.reaction_s += 0.25;
  const std::string text = arguments_of(robustness_study(stopped_and_moving(), "stopped", {usual, slow}));
  const auto own = text.find("\n### slow\nstopped\nmoving\n");
  ASSERT_NE(own, std::string::npos);
  EXPECT_THAT(text.substr(own), AllOf(HasSubstr("keeper.reaction_s = "), Not(HasSubstr("keeper.enabled"))));
  slow.scenario.keeper.guard.reaction_s += 0.25;
  EXPECT_NE(arguments_of(robustness_study(stopped_and_moving(), "stopped", {usual, slow})), text);
  std::vector<Arm> other = stopped_and_moving();
  other[1].settings.policy.settle_s += 0.1;
  EXPECT_NE(arguments_of(arms_study({}, other)), arguments_of(arms_study({}, stopped_and_moving())));
}

}  // namespace
}  // namespace trivela::experiment
