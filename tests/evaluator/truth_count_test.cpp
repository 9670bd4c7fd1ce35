#include "evaluator/counting/log_minutes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "evaluator/counting/log_opportunities.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using Int = std::int64_t;
constexpr Int kSecond_ns = 1'000'000'000;

/// Possessions of a simulated half, one every ten seconds, and what robots made of them.
class TwoCounts : public LogTest {
 protected:
  void possession(Int robot_id, Int number) {
    match_.writer().push(truths_, {robot_id, number, (10 * number + 5) * kSecond_ns, Int{1}, number, "kicked",
                                   10 * number * kSecond_ns, 0.5, 4.0, 0.0});
  }
  void counted(Int robot_id, Int own, const std::string& policy, std::optional<Int> at_s) {
    log::Value t_ns;
    if (at_s) t_ns = *at_s * kSecond_ns;
    match_.writer().push(assignments_, {robot_id, Int{1}, own, policy, 0.5, t_ns});
  }

  MatchLog match_{path(), session(), options()};
  log::TableId truths_ =
      match_.writer().table("possession_truths", {"robot_id", "seq", "t_ns", "half", "possession_id", "ending",
                                                  "start_t_ns", "start_x_m", "start_y_m", "start_heading_rad"});
  log::TableId assignments_ =
      match_.writer().table("assignments", {"robot_id", "half", "possession_id", "policy", "probability", "t_ns"});
};

const LoggedOpportunity& row_of(const LoggedOpportunities& logged, Int number) {
  return *std::ranges::find(logged.rows, number, &LoggedOpportunity::possession_id);
}

TEST_F(TwoCounts, MeetInTheFirstDecisionInPlay) {
  for (const Int number : {1, 2, 3}) possession(1, number);
  counted(1, 1, "moving", 10);
  counted(1, 2, "stopped", 13);  // it lost the ball for a while
  counted(1, 3, "stopped", 20);
  counted(1, 4, "moving", 31);
  match_.close();
  log::Reader reader(path());
  const TruthCount truths(reader);
  const Int session_id = reader.sessions().front().session_id;
  EXPECT_TRUE(truths.has(session_id));
  for (const auto& [own, number] : {std::pair{1, 1}, {2, 1}, {3, 2}, {4, 3}, {9, 9}})
    EXPECT_EQ(truths.number(session_id, 1, 1, own), number) << own;
  EXPECT_EQ(truths.number(session_id, 2, 1, 4), 4) << "of another robot nothing is known";
  const LoggedOpportunities logged = read_opportunities(reader, "match.db", false);
  ASSERT_EQ(logged.rows.size(), 3u);
  EXPECT_EQ(row_of(logged, 1).policy, "moving") << "chance decided with the first of the two";
  EXPECT_EQ(row_of(logged, 2).policy, "stopped");
  EXPECT_EQ(row_of(logged, 3).policy, "moving");
}

TEST_F(TwoCounts, OfATeamEachRobotsFirstIsAnother) {
  possession(1, 1);
  possession(2, 2);
  possession(1, 3);
  counted(1, 1, "moving", 10);
  counted(2, 1, "stopped", 20);
  counted(1, 2, "stopped", 30);
  match_.close();
  log::Reader reader(path());
  const LoggedOpportunities logged = read_opportunities(reader, "match.db", false);
  ASSERT_EQ(logged.rows.size(), 3u);
  EXPECT_EQ(row_of(logged, 2).robot_id, 2);
  EXPECT_EQ(row_of(logged, 2).policy, "stopped");
  EXPECT_EQ(row_of(logged, 3).policy, "stopped");
  for (const LoggedOpportunity& o : logged.rows) EXPECT_EQ(o.probability, 0.5);
}

TEST_F(TwoCounts, WithoutASimulatorTheRobotsOwnHolds) {
  counted(1, 1, "moving", 10);
  counted(1, 2, "stopped", 20);
  match_.close();
  log::Reader reader(path());
  EXPECT_FALSE(TruthCount(reader).has(reader.sessions().front().session_id));
  const LoggedOpportunities logged = read_opportunities(reader, "match.db", false);
  ASSERT_EQ(logged.rows.size(), 2u);
  EXPECT_EQ(row_of(logged, 2).policy, "stopped");
}

TEST_F(TwoCounts, AreOneWhereTheLogHasNoInstants) {
  for (const Int number : {1, 2}) possession(1, number);
  counted(1, 1, "moving", std::nullopt);
  counted(1, 2, "stopped", std::nullopt);
  match_.close();
  log::Reader reader(path());
  const LoggedOpportunities logged = read_opportunities(reader, "match.db", false);
  ASSERT_EQ(logged.rows.size(), 2u);
  EXPECT_EQ(row_of(logged, 1).policy, "moving");
  EXPECT_EQ(row_of(logged, 2).policy, "stopped");
}

}  // namespace
}  // namespace trivela::evaluator
