#include "evaluator/sessions/label_quality.hpp"

#include <gmock/gmock.h>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/table2/table2.hpp"
#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using Int = std::int64_t;

/// A match whose outcomes come with probabilities and flights.
class LabelQualityOfALog : public LogTest {
 protected:
  LabelQualityOfALog()
      : match(path(), session(), options()),
        outcomes(match.writer().table(
            "kick_outcomes",
            {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target", "observations", "p_on_target", "p_wide_left",
             "p_wide_right", "p_over", "p_short", "p_post", "p_bar", "p_blocked", "release_late_s"})),
        frames(match.writer().table("flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen",
                                                      "ball_x_m", "ball_y_m", "ball_z_m"})) {}

  /// Of a kick that is on target with `p_on_target`, otherwise blocked or nothing of all.
  void kick(Int half, const std::string& label, double p_on_target, double p_blocked, Int sightings = 30,
            log::Value release_late_s = {}) {
    const Int kick_id = match.kick(half, "unknown");
    match.writer().push(outcomes, {Int{1}, 1'000'000 + kick_id, Int{0}, kick_id, label, Int{label == "on_target"},
                                   sightings, p_on_target, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, p_blocked, release_late_s});
    kicks = kick_id;
  }

  /// The flight of the last kick: out to `turn_y_m` and, where it `comes_back`, half a metre back.
  void flight(double turn_y_m, bool comes_back) {
    const Int release_t_ns = (4 * (kicks - 1) + 3) * 20'000'000;
    const auto see = [&](double y_m) {
      ++seq;
      match.writer().push(frames, {Int{1}, seq, Int{0}, release_t_ns + ++shown * 500'000, Int{1}, 0.0, y_m, 0.5});
    };
    shown = 0;
    for (double y_m = 5.0; y_m < turn_y_m; y_m += 0.1) see(y_m);
    see(turn_y_m);
    for (double back_m = 0.1; comes_back && back_m < 0.55; back_m += 0.1) see(turn_y_m - back_m);
  }

  LabelQuality read() {
    match.close();
    return label_quality_of(log::Reader(path()));
  }

  MatchLog match;
  log::TableId outcomes, frames;
  Int kicks = 0, seq = 0, shown = 0;
};

TEST_F(LabelQualityOfALog, SumsTheDoubtOfTheLabelsByPolicyAndSightings) {
  kick(1, "on_target", 0.96, 0.04);
  kick(1, "blocked", 0.03, 0.97, 7);
  kick(2, "on_target", 0.99, 0.01);
  kick(2, "unknown", 0.6, 0.4, 7);
  const auto quality = read();
  EXPECT_TRUE(quality.has_probabilities);
  ASSERT_THAT(quality.doubts, SizeIs(2)) << "of one robot, by policy";
  EXPECT_EQ(quality.doubts[0].policy, "moving");
  EXPECT_NEAR(quality.doubts[0].doubt.inside, 0.01, 1e-12);
  EXPECT_NEAR(quality.doubts[1].doubt.inside, 0.04, 1e-12);
  EXPECT_NEAR(quality.doubts[1].doubt.outside, 0.03, 1e-12);
  double expected_wrong = 0.0;
  for (const SightingsRow& row : quality.rows) expected_wrong += row.expected_wrong;
  EXPECT_NEAR(expected_wrong, 0.08, 1e-12);
  ASSERT_THAT(quality.rows, SizeIs(5));
  EXPECT_EQ(quality.rows[2].kicks, 2) << "5 to 9";
  EXPECT_EQ(quality.rows[2].unknown, 1);
  EXPECT_EQ(quality.rows[4].kicks, 2) << "20 or more";
  const Report report = make_report(log::Reader(path()));
  EXPECT_NEAR(report.policies[0].efficiency_bounds().lo, 0.0, 1e-12) << "one label of inside may be wrong";
  EXPECT_NEAR(report.policies[0].efficiency_bounds().hi, 1.0, 1e-12) << "and one of outside";
  EXPECT_THAT(to_text(report), HasSubstr("Outcomes by sightings of the flight"));
}

TEST_F(LabelQualityOfALog, CompareBoundsWhatTheLabelsGetWrong) {
  for (int i = 0; i < 10; ++i) kick(1, i < 5 ? "on_target" : "blocked", i < 5 ? 0.96 : 0.04, i < 5 ? 0.04 : 0.96);
  for (int i = 0; i < 10; ++i) kick(2, i < 8 ? "on_target" : "blocked", i < 8 ? 1.0 : 0.0, i < 8 ? 0.0 : 1.0);
  match.close();
  std::string by;
  const auto comparison = compare_policies(read_log_kicks({path()}, {}, by), by);
  ASSERT_TRUE(comparison.groups[0].is_bounded());
  EXPECT_NEAR(comparison.groups[0].efficiency_bounds().lo, 0.4, 1e-12) << "0.2 expected: one may be";
  EXPECT_NEAR(comparison.groups[0].efficiency_bounds().hi, 0.6, 1e-12);
  EXPECT_FALSE(comparison.groups[1].is_bounded()) << "nothing is in doubt";
  EXPECT_NEAR(comparison.pairs[0].bounds.lo, 0.2, 1e-12);
  EXPECT_NEAR(comparison.pairs[0].bounds.hi, 0.4, 1e-12);
  EXPECT_THAT(to_text(comparison), HasSubstr("0.4 labels are expected to be wrong"));
}

TEST_F(LabelQualityOfALog, SaysThatTheBallLeavesLaterThanTheRobotsFileSays) {
  for (int i = 0; i < 7; ++i) kick(1, "on_target", 1.0, 0.0, 30, 0.08 + 0.01 * (i % 3));
  kick(1, "on_target", 1.0, 0.0, 30, -3.0);  // one track that means nothing
  kick(1, "on_target", 1.0, 0.0);            // not seen to leave
  const LabelQuality quality = read();
  EXPECT_THAT(
      quality.release_warnings(),
      testing::ElementsAre("robot 1: the ball leaves 0.09 s later than its file says (median of 8 kicks): measure "
                           "kicker.delay_s (trivela calibrate run)"));
  EXPECT_THAT(make_report(log::Reader(path())).warnings, testing::Contains(HasSubstr("leaves 0.09 s later")));
}

TEST_F(LabelQualityOfALog, SaysNothingOfFewReleases) {
  for (int i = 0; i < 7; ++i) kick(1, "on_target", 1.0, 0.0, 30, -0.1);
  EXPECT_THAT(read().release_warnings(), IsEmpty()) << "seven kicks";
}

TEST_F(LabelQualityOfALog, SaysNothingOfReleasesInTime) {
  for (int i = 0; i < 20; ++i) kick(1, "on_target", 1.0, 0.0, 30, i % 2 == 0 ? -0.029 : 0.029);
  const LabelQuality quality = read();
  ASSERT_THAT(quality.releases, SizeIs(1));
  EXPECT_EQ(quality.releases[0].kicks, 20);
  EXPECT_THAT(quality.release_warnings(), IsEmpty());
}

TEST_F(LabelQualityOfALog, BallsThatComeBackFromTheGoalLineContradictNothing) {
  for (const double y_m : {8.97, 9.02, 9.0, 8.95, 9.04, 6.1, 7.3}) {
    kick(1, "bar", 0.0, 0.0);
    flight(y_m, true);
  }
  const auto quality = read();
  EXPECT_EQ(quality.turns_at_goal, 5);
  EXPECT_THAT(quality.goal_warnings(), IsEmpty());
}

TEST_F(LabelQualityOfALog, BallsThatComeBackFromElsewhereDo) {
  for (const double y_m : {7.0, 7.03, 6.95, 7.05, 6.98, 6.1, 8.0}) {
    kick(1, "blocked", 0.0, 1.0);
    flight(y_m, true);
  }
  kick(1, "on_target", 1.0, 0.0);
  flight(9.8, false);
  const auto warnings = read().goal_warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0], HasSubstr("5 balls came back from y = 7.00 m"));
  EXPECT_THAT(warnings[0], HasSubstr("goal.y_m = 9.00 m"));
}

TEST_F(LabelQualityOfALog, FreeFlightsUntilTheStopContradictTheGoalsPlace) {
  for (int i = 0; i < 16; ++i) kick(1, "on_target", 1.0, 0.0);
  for (int i = 0; i < 2; ++i) kick(1, "unknown", 0.0, 0.2);
  EXPECT_THAT(read().goal_warnings(), IsEmpty()) << "two of 18";
}

TEST_F(LabelQualityOfALog, ManyFreeFlightsUntilTheStopAreALoudWarning) {
  for (int i = 0; i < 4; ++i) kick(1, "on_target", 1.0, 0.0);
  for (int i = 0; i < 12; ++i) kick(1, "unknown", 0.0, 0.2);
  match.close();
  const Report report = make_report(log::Reader(path()));
  EXPECT_THAT(to_text(report), HasSubstr("warning: 12 of 16 kicks were seen flying freely until the game was stopped"));
}

TEST(Densest, NeedsFourWithinReach) {
  EXPECT_FALSE(densest({}));
  EXPECT_FALSE(densest({1.0, 1.1, 1.2, 3.0, 4.0}));
  const auto found = densest({5.0, 1.0, 1.1, 1.2, 1.15, 3.0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 4);
  EXPECT_NEAR(found->y_m, 1.1, 1e-12);
}

}  // namespace
}  // namespace trivela::evaluator
