// One match of two halves, from the command line to Table 2.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kHalf_min = 2.5;

class Match : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<tests::Folder>();
    Program match{"trivela",
                  {"match", "--half", "stopped", "--half", "moving", "--minutes", fmt::format("{}", kHalf_min),
                   "--seed", "1", "--out", "match.db"},
                  folder_->path()};
    exit_code_ = match.wait();
    output_ = match.output();
    errors_ = match.errors();
    left_over_ = folder_->files(".toml");
    ASSERT_EQ(exit_code_, 0) << errors_;
    loose_ends_ = loose_ends_of(*folder_ / "match.db");
    log_ = std::make_unique<Reader>(*folder_ / "match.db");
  }
  static void TearDownTestSuite() {
    log_.reset();
    folder_.reset();
  }

  static nlohmann::json report() {
    Program report{"trivela", {"report", "match.db", "--json"}, folder_->path()};
    EXPECT_EQ(report.wait(), 0) << report.errors();
    return nlohmann::json::parse(report.output());
  }

  inline static std::unique_ptr<tests::Folder> folder_;
  inline static std::unique_ptr<Reader> log_;
  inline static int exit_code_ = -1;
  inline static std::string output_;
  inline static std::string errors_;
  inline static std::vector<std::string> left_over_;
  inline static std::vector<std::string> loose_ends_;
};

TEST_F(Match, EndsWellAndSaysHowFastItWas) {
  EXPECT_EQ(exit_code_, 0);
  EXPECT_THAT(output_, HasSubstr("times real time"));
  EXPECT_EQ(errors_, "");
}

TEST_F(Match, LeavesAFinalisedLogAndNothingElse) {
  EXPECT_THAT(loose_ends_, IsEmpty());
  EXPECT_THAT(left_over_, IsEmpty());
  const auto sessions = log_->sessions();
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_TRUE(sessions[0].simulated && sessions[0].simulated_clock);
  EXPECT_EQ(sessions[0].seed, 1);
  ASSERT_EQ(sessions[0].policies.size(), 2u);
  EXPECT_EQ(sessions[0].policies[0].policy, "stopped");
  EXPECT_EQ(sessions[0].policies[1].policy, "moving");
}

TEST_F(Match, LosesNothing) {
  EXPECT_THAT(gaps_of(*log_), IsEmpty());
  EXPECT_THAT(losses_of(*log_), IsEmpty());
  // Every cycle is there, in every stream that has one row a cycle.
  const std::int64_t cycles = number_of(*log_, "SELECT count(*) FROM referee");
  EXPECT_GE(cycles, static_cast<std::int64_t>(2 * kHalf_min * 60 * 50));
  for (const char* const stream :
       {"odometry", "vision_frames", "flight_frames", "world_states", "drive_commands", "kicker_status"}) {
    EXPECT_EQ(number_of(*log_, fmt::format("SELECT count(*) FROM {}", stream)), cycles) << stream;
  }
}

TEST_F(Match, EveryFiredDecisionHasItsOrderReceiptAndOutcome) {
  const auto kicks = rows_of(*log_, R"(
    SELECT d.kick_id,
      (SELECT count(*) FROM kick_orders AS o WHERE o.kick_id = d.kick_id),
      (SELECT count(*) FROM kick_receipts AS r WHERE r.kick_id = d.kick_id),
      (SELECT total(accepted) FROM kick_receipts AS r WHERE r.kick_id = d.kick_id),
      (SELECT count(*) FROM kick_outcomes AS c WHERE c.kick_id = d.kick_id),
      (SELECT count(*) FROM kick_truths AS t WHERE t.kick_id = d.kick_id)
    FROM kick_decisions AS d WHERE d.fire = 1)");
  EXPECT_GE(kicks.size(), 40u);
  std::set<std::int64_t> ids;
  for (const Row& kick : kicks) {
    const auto id = std::get<std::int64_t>(kick[0]);
    EXPECT_TRUE(ids.insert(id).second) << id << " was decided twice";
    EXPECT_EQ(std::get<std::int64_t>(kick[1]), 1) << "orders of " << id;
    EXPECT_EQ(std::get<std::int64_t>(kick[2]), 1) << "receipts of " << id;
    const auto accepted = static_cast<std::int64_t>(std::get<double>(kick[3]));
    EXPECT_GE(std::get<std::int64_t>(kick[4]), accepted) << "outcomes of " << id;
    EXPECT_EQ(std::get<std::int64_t>(kick[5]), accepted) << "truths of " << id;
  }
  for (const char* const stream : {"kick_orders", "kick_receipts", "kick_outcomes", "kick_truths"}) {
    for (const Row& row : rows_of(*log_, fmt::format("SELECT kick_id FROM {}", stream))) {
      EXPECT_TRUE(ids.contains(std::get<std::int64_t>(row[0]))) << stream << " of a kick that nobody decided";
    }
  }
}

TEST_F(Match, DecisionsHaveTheShadowsTheyCount) {
  EXPECT_GT(number_of(*log_, "SELECT sum(shadow_count) FROM kick_decisions"), 0);
  EXPECT_EQ(number_of(*log_, "SELECT sum(shadow_count) FROM kick_decisions"),
            number_of(*log_, "SELECT count(*) FROM shadow_decisions"));
}

TEST_F(Match, EachHalfHasPossessionsOfItsOwn) {
  EXPECT_EQ(number_of(*log_, R"(
    SELECT count(*) FROM possession_truths AS a JOIN possession_truths AS b USING (start_x_m, start_y_m)
    WHERE a.half = 1 AND b.half = 2)"),
            0);
  EXPECT_GE(number_of(*log_, "SELECT count(DISTINCT start_x_m) FROM possession_truths WHERE half = 1"), 20);
  EXPECT_FALSE(log_->sessions()[0].paired_halves);
}

TEST_F(Match, SaysHowLongItWasToLast) {
  EXPECT_EQ(log_->sessions()[0].planned_s, 2 * kHalf_min * 60.0);
  const auto length = report().at("data_quality").at("lengths").at(0);
  EXPECT_GE(length.at("recorded_s").get<double>(), 2 * kHalf_min * 60.0);
  EXPECT_EQ(length.at("cut_short"), false);
}

TEST(PairedMatch, BothHalvesMeetTheSamePossessionsAndAreComparedAsPairs) {
  const tests::Folder folder;
  Program match{"trivela",
                {"match", "--half", "stopped", "--half", "moving", "--paired-halves", "--minutes",
                 fmt::format("{}", kHalf_min), "--seed", "3", "--out", "match.db"},
                folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  const Reader log{folder / "match.db"};
  EXPECT_TRUE(log.sessions()[0].paired_halves);
  const auto common = rows_of(log, R"(
    SELECT a.start_x_m - b.start_x_m, a.start_y_m - b.start_y_m, a.start_heading_rad - b.start_heading_rad
    FROM possession_truths AS a JOIN possession_truths AS b USING (possession_id) WHERE a.half = 1 AND b.half = 2)");
  EXPECT_GE(common.size(), 20u);
  for (const Row& row : common) EXPECT_EQ(row, (Row{0.0, 0.0, 0.0}));
  Program compare{"trivela", {"compare", "match.db", "--json"}, folder.path()};
  ASSERT_EQ(compare.wait(), 0) << compare.errors();
  const auto json = nlohmann::json::parse(compare.output());
  EXPECT_EQ(json.at("design"), "paired");
  const auto pairs = json.at("comparisons").at(0).at("pairs");
  EXPECT_EQ(pairs.at("both").get<std::size_t>() + pairs.at("new_only").get<std::size_t>() +
                pairs.at("old_only").get<std::size_t>() + pairs.at("neither").get<std::size_t>(),
            common.size());
}

TEST_F(Match, ReportAgreesWithTheRowsOfTheLog) {
  const auto json = report();
  EXPECT_EQ(json.at("simulated"), true);
  ASSERT_EQ(json.at("policies").size(), 2u);
  for (const auto& policy : json.at("policies")) {
    const auto name = policy.at("policy").get<std::string>();
    const auto count = [&](const std::string& outcomes) {
      return number_of(*log_, fmt::format(R"(
        SELECT count(*) FROM kick_receipts AS r
        JOIN kick_decisions AS d USING (kick_id) JOIN kick_outcomes AS c USING (kick_id)
        WHERE r.accepted = 1 AND d.fire = 1 AND d.policy = '{}' AND c.outcome {})",
                                          name, outcomes));
    };
    const std::int64_t inside = count("= 'on_target'");
    const std::int64_t outside = count("NOT IN ('on_target', 'unknown')");
    EXPECT_GT(inside, 0) << name;
    EXPECT_EQ(policy.at("inside"), inside) << name;
    EXPECT_EQ(policy.at("outside"), outside) << name;
    EXPECT_EQ(policy.at("unknown"), count("= 'unknown'")) << name;
    const auto kicks = static_cast<double>(inside + outside);
    const double p = static_cast<double>(inside) / kicks;
    EXPECT_NEAR(policy.at("efficiency").get<double>(), p, 1e-12);
    // Wilson's interval, z = 1.959964.
    const double z2 = 1.959963984540054 * 1.959963984540054;
    const double centre = (p + z2 / (2 * kicks)) / (1 + z2 / kicks);
    const double reach = std::sqrt(z2 * (p * (1 - p) / kicks + z2 / (4 * kicks * kicks))) / (1 + z2 / kicks);
    EXPECT_NEAR(policy.at("wilson95").at(0).get<double>(), centre - reach, 1e-9);
    EXPECT_NEAR(policy.at("wilson95").at(1).get<double>(), centre + reach, 1e-9);
    std::int64_t misses = 0;
    for (const auto& [reason, n] : policy.at("misses").items()) {
      EXPECT_EQ(n, count("= '" + reason + "'")) << reason;
      misses += n.get<std::int64_t>();
    }
    EXPECT_EQ(misses, outside);
    const double played_min = real_of(*log_, fmt::format(R"(
        SELECT total(playing) * 0.02 / 60 FROM referee JOIN session_policies USING (half) WHERE policy = '{}')",
                                                         name));
    EXPECT_NEAR(policy.at("played_min").get<double>(), played_min, 0.01);
    EXPECT_LT(played_min, kHalf_min) << "the referee stops the game after each possession";
    const double all_kicks = kicks + policy.at("unknown").get<double>();
    EXPECT_NEAR(policy.at("kicks_per_min").get<double>(), all_kicks / played_min, 0.05);
  }
  EXPECT_EQ(json.at("data_quality").at("data_lost"), false);
  EXPECT_THAT(json.at("data_quality").at("unclosed_kicks"), IsEmpty());
}

TEST_F(Match, ReportIsATableForPeopleToo) {
  Program report{"trivela", {"report", "match.db"}, folder_->path()};
  EXPECT_EQ(report.wait(), 0) << report.errors();
  EXPECT_THAT(report.output(), HasSubstr("stopped"));
  EXPECT_THAT(report.output(), HasSubstr("moving"));
}

// "4 sd": an outcome may be mistaken only where the crossing is that near to the edge of another one.
TEST_F(Match, OutcomesAreMistakenOnlyWhereTheCrossingIsWithinTheObservationNoiseOfAnEdge) {
  std::map<std::string, std::map<std::string, int>> seen_as;  // by truth
  std::set<std::string> outcomes;
  int compared = 0, mistaken = 0, unknown = 0;
  for (const auto& kick : log_->kicks()) {
    if (!kick.accepted.value_or(false)) continue;
    ASSERT_TRUE(kick.observed && kick.truth) << kick.kick_id;
    const std::string& truth = kick.truth->outcome;
    const std::string& seen = kick.observed->outcome;
    ++seen_as[truth][seen];
    outcomes.insert({truth, seen});
    ++compared;
    if (seen == "unknown") ++unknown;
    if (seen == "unknown" || seen == truth) continue;
    ++mistaken;
    ASSERT_TRUE(kick.truth_margin_m && kick.sd_cross_m) << truth << " seen as " << seen;
    EXPECT_LE(*kick.truth_margin_m, 4 * *kick.sd_cross_m) << truth << " seen as " << seen;
  }
  fmt::print("{:<12}", "truth \\ seen");
  for (const std::string& seen : outcomes) fmt::print(" {:>10}", seen);
  fmt::print("\n");
  for (const auto& [truth, row] : seen_as) {
    fmt::print("{:<12}", truth);
    for (const std::string& seen : outcomes) fmt::print(" {:>10}", row.contains(seen) ? row.at(seen) : 0);
    fmt::print("\n");
  }
  fmt::print("{} kicks, {} mistaken, {} unknown\n", compared, mistaken, unknown);
  EXPECT_GE(outcomes.size(), 3u) << "too few kinds of outcome to say anything";
  EXPECT_LE(mistaken, compared / 10);
  EXPECT_LE(unknown, compared / 20);
}

}  // namespace
}  // namespace trivela::e2e
