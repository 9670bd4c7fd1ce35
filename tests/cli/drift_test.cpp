// `trivela drift`: text, JSON, exit codes, whose kicks are one series.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/watched_log.hpp"

namespace trivela::cli {
namespace {

using evaluator::WatchedLog;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr double kLower_m = -0.7;

class DriftVerb : public evaluator::LogTest {
 protected:
  /// A session on a field, `day` days after the first.
  static log::Session on_field(int day, bool simulated = false) {
    auto played = session();
    played.uuid = fmt::format("{:08x}-0000-4000-8000-000000000001", day + 1);
    played.seed.reset();
    played.simulated = played.simulated_clock = simulated;
    played.realtime_offset_ns = simulated ? 0 : (1'795'500'000 + day * 86'400) * std::int64_t{1'000'000'000};
    return played;
  }

  void write(const std::string& name, int day, int before, int after, bool simulated = false) {
    WatchedLog log(path(name), on_field(day, simulated), options(), 4 + static_cast<std::uint32_t>(day), 1000 * day);
    log.kicks(1, before);
    log.kicks(1, after, kLower_m);
    log.close();
  }

  VerbRun run(const std::vector<std::string>& logs, bool as_json = false) const {
    std::vector<std::string> words{"drift"};
    for (const std::string& log : logs) words.push_back(path(log).string());
    if (as_json) words.emplace_back("--json");
    return run_verbs({add_drift}, words);
  }
};

TEST_F(DriftVerb, NamesTheKickTheSizeAndTheCorrectionAndEndsWithThree) {
  write("worn.db", 0, 40, 20);
  const VerbRun said = run({"worn.db"});
  EXPECT_EQ(said.exit_code, kDoneWithLoss);
  EXPECT_THAT(said.out, AllOf(HasSubstr("robot 1: 60 kicks in 1 session\n"),
                              HasSubstr("from kick 41 on (2026-11-24 06:00:41 UTC, kick_id 41): exit speed fell by "),
                              HasSubstr("multiply exit_speeds_mps of its [table] by 0.9"),
                              HasSubstr("since then: below its table by ")));
  EXPECT_THAT(said.errors, IsEmpty());
}

TEST_F(DriftVerb, SaysTheSameAsJson) {
  write("worn.db", 0, 40, 20);
  const VerbRun said = run({"worn.db"}, true);
  EXPECT_EQ(said.exit_code, kDoneWithLoss);
  const json robot = json::parse(said.out)["robots"].at(0);
  EXPECT_EQ(robot["robot"], 1);
  EXPECT_EQ(robot["simulated"], false);
  EXPECT_EQ(robot["kicks"], 60);
  ASSERT_THAT(robot["drifts"], SizeIs(1));
  const json drift = robot["drifts"][0];
  EXPECT_EQ(drift["kind"], "exit_speed");
  EXPECT_EQ(drift["kick"], 41);
  EXPECT_EQ(drift["kick_id"], "41");
  EXPECT_GE(drift["found_with_kick"], 41);
  EXPECT_LE(drift["found_with_kick"], 46);
  EXPECT_NEAR(drift["multiply_speeds_by"].get<double>(), std::exp(drift["ln_speed"]["value"].get<double>()), 1e-12);
  EXPECT_NEAR(drift["height_m"].get<double>(), kLower_m, 0.2);
}

TEST_F(DriftVerb, OfAKickerThatStaysEndsWithZero) {
  write("well.db", 0, 60, 0);
  const VerbRun said = run({"well.db"});
  EXPECT_EQ(said.exit_code, kDone);
  EXPECT_THAT(said.out, AllOf(HasSubstr("no change: "), HasSubstr("60 heights"), Not(HasSubstr("from kick"))));
}

TEST_F(DriftVerb, GoesOnFromLogToLogInTheOrderOfTheirTime) {
  write("monday.db", 0, 30, 0);
  write("tuesday.db", 1, 15, 15);
  for (const auto& logs : {std::vector<std::string>{"monday.db", "tuesday.db"}, {"tuesday.db", "monday.db"}}) {
    const VerbRun said = run(logs);
    EXPECT_EQ(said.exit_code, kDoneWithLoss);
    EXPECT_THAT(said.out,
                AllOf(HasSubstr("robot 1: 60 kicks in 2 sessions\n"), HasSubstr("from kick 46 on (2026-11-25")));
  }
}

TEST_F(DriftVerb, EachRobotsKicksAreAStoryOfTheirOwn) {
  WatchedLog log(path(), on_field(0), options(), 4);
  log.kicks(1, 40);
  log.kicks(2, 40);
  log.kicks(1, 20, kLower_m);
  log.kicks(2, 20);
  log.close();
  const json robots = json::parse(run({"match.db"}, true).out)["robots"];
  ASSERT_THAT(robots, SizeIs(2));
  ASSERT_THAT(robots[0]["drifts"], SizeIs(1));
  EXPECT_EQ(robots[0]["drifts"][0]["kick"], 41);
  EXPECT_EQ(robots[1]["robot"], 2);
  EXPECT_THAT(robots[1]["drifts"], IsEmpty());
}

TEST_F(DriftVerb, ASimulatedSessionIsAKickerOfItsOwn) {
  write("a.db", 0, 40, 0, true);
  write("b.db", 1, 0, 40, true);
  const VerbRun said = run({"a.db", "b.db"});
  EXPECT_EQ(said.exit_code, kDone) << said.out;
  EXPECT_THAT(said.out, AllOf(HasSubstr("SIMULATED"), HasSubstr("session 00000001-"), HasSubstr("session 00000002-")));
}

TEST_F(DriftVerb, ALogThatIsNamedTwiceCountsOnce) {
  write("worn.db", 0, 40, 20);
  const VerbRun said = run({"worn.db", "worn.db"});
  EXPECT_THAT(said.out, HasSubstr("robot 1: 60 kicks in 1 session\n"));
  EXPECT_THAT(said.errors, HasSubstr("worn.db"));
}

TEST_F(DriftVerb, WithoutKicksSaysSo) {
  evaluator::MatchLog match(path(), session(), options());
  match.referee(1.0, 1, true);
  match.close();
  EXPECT_EQ(run({"match.db"}).exit_code, kDone);
  EXPECT_EQ(run({"match.db"}).out, "no kick that was accepted\n");
  EXPECT_THAT(json::parse(run({"match.db"}, true).out)["robots"], IsEmpty());
}

TEST_F(DriftVerb, KicksWithoutPredictionsAreTooFewToTell) {
  evaluator::MatchLog match(path(), session(), options());
  match.kicks(1, "on_target", 30);
  match.close();
  const VerbRun said = run({"match.db"});
  EXPECT_EQ(said.exit_code, kDone);
  EXPECT_THAT(said.out, HasSubstr("too few heights to tell its level"));
}

TEST_F(DriftVerb, ALogThatIsNotThereIsNamed) { EXPECT_THROW(run({"nowhere.db"}), std::runtime_error); }

// Simulated: 200 kickers, each of another seed, lose 3 % of their speed after 60 kicks.
TEST_F(DriftVerb, FindsAFallOfThreePercentWithinSixteenKicksAtTheMedian) {
#ifdef TRIVELA_SANITIZE
  GTEST_SKIP() << "forty thousand possessions take minutes";
#endif
  constexpr int kBefore = 60;
  run_verbs({add_simulate}, {"simulate", "--arms", "predictive", "--matches", "200", "--possessions", "200", "--seed",
                             "1000", "--world", "kicker.drop_ratio=0.03", "--world",
                             fmt::format("kicker.drop_after_kicks={}", kBefore), "--out", path().string()});
  const json robots = json::parse(run({"match.db"}, true).out)["robots"];
  std::vector<double> late;
  for (const json& robot : robots) {
    ASSERT_GT(robot["kicks"], kBefore + 30);
    double kicks = std::numeric_limits<double>::infinity();
    for (const json& drift : robot["drifts"])
      if (drift["found_with_kick"] > kBefore) kicks = std::min(kicks, drift["found_with_kick"].get<double>() - kBefore);
    late.push_back(kicks);
  }
  ASSERT_THAT(late, SizeIs(200));
  std::ranges::sort(late);
  EXPECT_LE(0.5 * (late[99] + late[100]), 16.0);
}

}  // namespace
}  // namespace trivela::cli
