// Sections of the page of a report, from plain data.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/stats/poisson.hpp"

namespace trivela::evaluator::page {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

KickTimeline kick(const std::string& policy, const std::string& outcome, double x_m, double z_m,
                  double distance_m = 5.0) {
  KickTimeline timeline;
  timeline.robot_id = 1;
  timeline.number = 7;
  timeline.half = 1;
  timeline.policy = policy;
  timeline.distance_m = distance_m;
  timeline.power = 20.0;
  timeline.robot = {1.0, 4.0, 0.0};
  timeline.predicted = TimelineEnd{"", x_m, z_m - 0.1, std::nullopt, std::nullopt};
  timeline.observed = TimelineEnd{outcome, x_m, z_m, 0.05, 0.6};
  return timeline;
}

/// A report of two policies and the kicks that it counts.
struct TwoPolicies {
  TwoPolicies() {
    report.policies.resize(2);
    report.policies[0].policy = "stopped";
    report.policies[0].kicks_by_outcome = {{"on_target", 34}, {"over", 31}};
    report.policies[0].played_min = 10.0;
    report.policies[1].policy = "moving";
    report.policies[1].kicks_by_outcome = {{"on_target", 100}, {"post", 30}, {"unknown", 2}};
    report.policies[1].played_min = 10.0;
    data.logs = {{"match.db", std::string(64, 'a')}};
    data.no_comparison = "fewer than two policies";
  }
  PageView view() const { return {report, data, false}; }

  Report report;
  PageData data;
};

TEST(PageText, MakesTextsOfAnybodyTexts) {
  EXPECT_EQ(html("<b a=\"'&\">"), "&lt;b a=&quot;&#39;&amp;&quot;&gt;");
  EXPECT_EQ(html("a\x01z"), "a\\x01z");
  EXPECT_EQ(html("a\xffz"), "a\\xffz");
  EXPECT_EQ(html("\u00e9"), "\u00e9");
}

TEST(PageText, LetsNoJsonEndItsScript) {
  EXPECT_EQ(script_json(Json{{"a", "</script><!--"}}), "{\"a\":\"\\u003c/script>\\u003c!--\"}");
  EXPECT_EQ(Json::parse(script_json(Json{{"a", "</script>"}}))["a"], "</script>");
}

// printf '' | openssl dgst -sha256 -binary | base64; the same of abc.
TEST(PageText, NamesAScriptByItsHash) {
  EXPECT_EQ(csp_hash(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
  EXPECT_EQ(csp_hash("abc"), "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
}

TEST(PageVerdict, SaysWhatEachPolicyHadWhereNothingIsCompared) {
  const TwoPolicies two;
  const std::string text = verdict_section(two.view());
  EXPECT_THAT(text, HasSubstr("stopped: 34 of 65 kicks on target, 52.3 % (95 % 40.4 % to 64.0 %)."));
  EXPECT_THAT(text, HasSubstr("Nothing is compared: fewer than two policies."));
}

TEST(PageTable2, HasTheRowsOfTheReport) {
  const TwoPolicies two;
  const std::string text = table2_section(two.view());
  EXPECT_THAT(text, HasSubstr("<th scope=\"row\">stopped</th><td>34</td><td>31</td><td>0</td><td>52.3 %</td>"));
  EXPECT_THAT(text, HasSubstr("<th scope=\"row\">moving</th><td>100</td><td>30</td><td>2</td><td>76.9 %</td>"));
  EXPECT_THAT(text, Not(HasSubstr("By robot")));
}

TEST(PageForest, HasARowForEachPolicyRobotAndDistance) {
  TwoPolicies two;
  two.data.kicks = {{0, kick("moving", "on_target", 0.1, 0.5, 3.5)}, {0, kick("moving", "post", 1.1, 0.5, 3.6)}};
  RobotRow robot;
  robot.policy = "moving";
  robot.robot_id = 4;
  robot.kicks_by_outcome = {{"on_target", 3}};
  two.report.robots = {robot};
  const std::string text = forest_section(two.view());
  EXPECT_THAT(text, HasSubstr("34/65, 52.3 %"));
  EXPECT_THAT(text, HasSubstr("robot 4, moving"));
  EXPECT_THAT(text, HasSubstr("3 to 4 m, moving"));
  EXPECT_THAT(text, HasSubstr("1/2, 50.0 %"));
}

TEST(PageGoalMouth, DrawsEachCrossingWithItsSpreadToScale) {
  TwoPolicies two;
  two.data.kicks = {{0, kick("moving", "on_target", 0.0, 0.5)}, {0, kick("moving", "over", 0.5, 1.6)}};
  const std::string text = goal_mouth_section(two.view());
  EXPECT_EQ(count(text, "data-kick="), 2U);
  // 512 units for 4.25 m: 0.05 m are 6.02
  EXPECT_THAT(text, HasSubstr("<circle class=\"spread inside\" cx=\"260.0\""));
  EXPECT_EQ(count(text, "r=\"6.02\""), 2U);
  EXPECT_THAT(text, HasSubstr("on target: 1"));
  EXPECT_THAT(text, HasSubstr("wide, over, short: 1"));
}

TEST(PageGoalMouth, KeepsWhatFlewFarAtItsEdge) {
  TwoPolicies two;
  two.data.kicks = {{0, kick("moving", "wide_right", 40.0, 0.5)}};
  EXPECT_THAT(goal_mouth_section(two.view()), HasSubstr("1 beyond the picture lie at its edge"));
}

TEST(PageGoalMouth, SaysWhereNoCrossingWasSeen) {
  TwoPolicies two;
  two.data.kicks = {{0, kick("moving", "on_target", 0.0, 0.5)}};
  two.data.kicks[0].timeline.observed->x_m.reset();
  EXPECT_THAT(goal_mouth_section(two.view()), HasSubstr("No kick has an observed crossing"));
  two.data.kicks.clear();
  EXPECT_THAT(goal_mouth_section(two.view()), HasSubstr("There are no kicks."));
}

TEST(PagePitch, ShowsWhereKicksWereTakenAndChancesHeld) {
  TwoPolicies two;
  two.data.kicks = {{0, kick("moving", "on_target", 0.0, 0.5)}};
  two.data.held_chances = {{"moving", 2.0, 3.0, true}, {"moving", -2.0, 3.0, false}, {"moving", 90.0, 3.0, false}};
  const std::string text = pitch_section(two.view());
  EXPECT_EQ(count(text, "data-kick="), 1U);
  EXPECT_THAT(text, HasSubstr("another policy would have kicked: 1"));
  EXPECT_THAT(text, HasSubstr(">held: 2<"));
  EXPECT_THAT(text, HasSubstr("1 off the field are not drawn"));
}

TEST(PageRates, GivesEventsByTheMinutesOfPlay) {
  TwoPolicies two;
  two.data.opportunities = {{"stopped", 80}};
  const std::string text = rates_section(two.view());
  EXPECT_THAT(text, HasSubstr("stopped: 80 in 10.0 min"));
  EXPECT_THAT(text, HasSubstr("moving: 132 in 10.0 min"));
  two.report.policies[0].played_min.reset();
  two.report.policies[1].played_min.reset();
  EXPECT_THAT(rates_section(two.view()), HasSubstr("How long was played is not in the log."));
}

// R 4.2.2: poisson.test(10, 2)$conf.int, poisson.test(0, 2)$conf.int
TEST(RateInterval, IsThatOfPoissonTest) {
  const auto ten = stats::rate_interval({10, 2.0});
  EXPECT_NEAR(ten.lo, 2.397694, 1e-6);
  EXPECT_NEAR(ten.hi, 9.195178, 1e-6);
  const auto none = stats::rate_interval({0, 2.0});
  EXPECT_EQ(none.lo, 0.0);
  EXPECT_NEAR(none.hi, 1.844440, 1e-6);
  EXPECT_THROW(stats::rate_interval({3, 0.0}), std::invalid_argument);
}

TEST(PagePredictions, FindsTheDriftOfHeights) {
  TwoPolicies two;
  for (int i = 0; i < 16; ++i) {
    two.data.kicks.push_back({0, kick("moving", "on_target", 0.0, 0.6)});  // predicted 0.1 m lower
    two.data.kicks.back().timeline.observed->z_m = i % 2 == 0 ? 0.61 : 0.59;
  }
  std::string text = prediction_section(two.view());
  EXPECT_EQ(count(text, "<td>+10.0 cm</td>"), 1U) << "kicks of one set-point have one mean";
  EXPECT_THAT(text, HasSubstr("No kick was given a probability"));
  for (PageKick& bounced : two.data.kicks) bounced.timeline.bounced = true;
  EXPECT_THAT(prediction_section(two.view()), HasSubstr("No kick has both"));
}

TEST(PagePredictions, ComparesProbabilitiesWithOutcomes) {
  TwoPolicies two;
  two.data.predictions = {{0.85, true}, {0.85, false}, {0.2, false}, {1.0, true}};
  const std::string text = prediction_section(two.view());
  EXPECT_THAT(text, HasSubstr("predicted 85.0 %: 1 of 2 on target"));
  EXPECT_THAT(text, HasSubstr("2.9 of 4 predicted, 2 came"));
}

/// A robot whose kicker changed with the second of two kicks, which the list has as k0 and k1.
TwoPolicies changed_kicker() {
  TwoPolicies two;
  two.data.kicks.assign(2, {0, kick("moving", "on_target", 0.0, 0.5)});
  RobotDrift robot{.robot_id = 1};
  for (std::int64_t id = 1; id <= 2; ++id) {
    two.data.kicks[static_cast<std::size_t>(id - 1)].timeline.kick_id = id;
    two.data.kicks[static_cast<std::size_t>(id - 1)].timeline.number = id;
    robot.kicks.push_back({.kick_id = id});
  }
  robot.timeline.drifts = {{.changed = 1, .found = 1, .factor = {std::log(0.95), 0.01}, .height_m = -0.4}};
  two.data.drift.robots = {robot};
  return two;
}

TEST(PageDrift, NamesTheKickByItsPlaceInTheListTheSizeAndTheCorrection) {
  const std::string text = drift_section(changed_kicker().view());
  EXPECT_THAT(text, HasSubstr("robot 1, 2 kicks: changed at kick <a href=\"#k1\">1:2</a>"));
  EXPECT_THAT(text, HasSubstr("exit speed fell by 5.0 % (standard error 1.0)"));
  EXPECT_THAT(text, HasSubstr("multiply exit_speeds_mps of its [table] by 0.950"));
}

TEST(PageDrift, LinksNowhereWhereThereIsNoList) {
  TwoPolicies two = changed_kicker();
  two.data.kicks.resize(kMostKicks + 1, two.data.kicks.front());
  const std::string text = drift_section(two.view());
  EXPECT_THAT(text, HasSubstr("changed at kick_id 2"));
  EXPECT_THAT(text, Not(HasSubstr("href")));
}

TEST(PageDrift, SaysThatNothingChangedOrThatThereAreTooFewKicks) {
  TwoPolicies two;
  EXPECT_THAT(drift_section(two.view()), HasSubstr("There is no kick"));
  RobotDrift well{.robot_id = 1}, hardly_seen{.robot_id = 2};
  well.kicks.resize(60);
  well.timeline.level = {.heights = 50, .height = {0.0101, 0.002}};
  hardly_seen.kicks.resize(9);
  hardly_seen.timeline.level = {.heights = 7};
  two.data.drift.robots = {well, hardly_seen};
  const std::string text = drift_section(two.view());
  EXPECT_THAT(text,
              HasSubstr("robot 1, 60 kicks: no change found; above its table by 1.0 % of speed (standard error 0.2, "
                        "50 heights)"));
  EXPECT_THAT(text,
              HasSubstr("robot 2, 9 kicks: too few kicks to say: the height of 7 was seen, and a change is looked "
                        "for after the first 20 of a policy"));
}

TEST(PageDrift, CountsWhatDidNotChangeInALargeExperiment) {
  TwoPolicies two = changed_kicker();
  RobotDrift well{.robot_id = 1, .simulated = true};
  well.kicks.resize(60);
  two.data.drift.robots.resize(301, well);
  const std::string text = drift_section(two.view());
  EXPECT_EQ(count(text, "<li>"), 22U) << "the one that changed, twenty that did not, and how many more";
  EXPECT_THAT(text, HasSubstr("and 280 more without a change"));
}

TEST(PageChanges, HasATableOfWhatIsNotAsInTheLogBefore) {
  TwoPolicies two;
  two.data.logs = {{"sunday.db", ""}, {"<saturday>.db", ""}};
  two.data.changes = {{1, 0, {{"settings", "policy.keep_off_m", {{"2.5"}, {"3.0", "4.0"}}}}}};
  const std::string text = changes_section(two.view());
  EXPECT_THAT(text, HasSubstr("<h3>sunday.db, after &lt;saturday&gt;.db</h3>"));
  EXPECT_THAT(text, HasSubstr("<th scope=\"row\">settings policy.keep_off_m</th><td>2.5</td><td>3.0, 4.0</td>"));
  two.data.changes[0].differences.clear();
  EXPECT_THAT(changes_section(two.view()), HasSubstr("Settings, robots, versions, scenario and seed are alike."));
}

TEST(PageChanges, KeepsALongListShort) {
  TwoPolicies two;
  two.data.logs = {{"a.db", ""}, {"b.db", ""}};
  two.data.changes = {{0, 1, std::vector<LogDifference>(100, {"settings", "key", {{"1"}, {"2"}}})}};
  const std::string text = changes_section(two.view());
  EXPECT_EQ(count(text, "settings key"), 40U);
  EXPECT_THAT(text, HasSubstr("And 60 more keys: trivela compare a.db b.db --all has them."));
}

TEST(ReportPage, OfOneLogHasNothingThatChangedSinceTheLogBefore) {
  TwoPolicies two;
  EXPECT_THAT(to_html(two.report, two.data), Not(HasSubstr("since the log before")));
  two.data.logs.push_back(two.data.logs.front());
  const std::string text = to_html(two.report, two.data);
  EXPECT_EQ(count(text, "What changed since the log before"), 2U) << "above the section and in the contents";
  EXPECT_THAT(text, HasSubstr("<a href=\"#changes\">"));
}

TEST(PageHeld, SaysWhyAndWhatTheShadowsWouldHaveDone) {
  TwoPolicies two;
  two.data.shadows = {"moving", "stopped"};
  two.data.held = {{"moving", "not_aligned", 400, 30, {{"stopped", {9, 5}}}}, {"moving", "not_playing", 70, 9, {}}};
  const std::string text = held_section(two.view());
  EXPECT_THAT(text, HasSubstr("400 in 30 chances"));
  EXPECT_THAT(text, HasSubstr("<td>in 5 chances of 30</td>"));
  EXPECT_THAT(text, HasSubstr("70 cycles in which the game stood"));
  EXPECT_THAT(text, Not(HasSubstr("not playing")));
  two.data.held.clear();
  EXPECT_THAT(held_section(two.view()), HasSubstr("no decision that held"));
}

TEST(PageHeld, AddsUpWhatTheShadowsPredictedAndCallsItAnEstimate) {
  TwoPolicies two;
  two.data.shadows = {"predictive"};
  two.data.held = {{"moving", "not_aligned", 400, 30, {{"predictive", {9, 3}}}}};
  two.data.held_chances = {{"moving", 0.0, 4.0, true, 0.75},
                           {"moving", 0.0, 4.0, true, 0.5},
                           {"moving", 0.0, 4.0, true, std::nullopt},
                           {"moving", 0.0, 4.0, false, std::nullopt},
                           {"stopped", 0.0, 4.0, true, std::nullopt}};
  const std::string text = held_section(two.view());
  EXPECT_THAT(text, HasSubstr("in 3 chances in which moving kicked nothing"));
  EXPECT_THAT(text, HasSubstr("in 2 of them it predicted"));
  EXPECT_THAT(text, HasSubstr("add up to 1.2 shots on target"));
  EXPECT_THAT(text, HasSubstr("a model&#39;s estimate and no outcome"));
  EXPECT_THAT(text, Not(HasSubstr("in which stopped kicked nothing"))) << "nobody predicted";
  two.data.held_chances.clear();
  EXPECT_THAT(held_section(two.view()), Not(HasSubstr("estimate")));
}

TEST(PageKickList, TellsTheInstantByUtcAndByTheMatch) {
  KickTimeline timeline = kick("moving", "on_target", 0.0, 0.5);
  timeline.half = 2;
  timeline.half_time_s = 184.52;
  timeline.utc_ns = 1'795'510'033'120'000'000;
  EXPECT_EQ(match_time_text(timeline), "2, 3:04.5");
  EXPECT_EQ(instant_text(timeline), "2026-11-24 08:47:13.12");
  timeline.half_time_s.reset();
  timeline.utc_ns = timeline.t_ns = 73'200'000'000;
  EXPECT_EQ(match_time_text(timeline), "2");
  EXPECT_EQ(instant_text(timeline), "+73.20 s");
}

TEST(PageKickList, HasAReplayForEachUntilTheyAreTooMany) {
  TwoPolicies two;
  two.data.kicks.assign(kMostReplays, {0, kick("moving", "on_target", 0.0, 0.5)});
  EXPECT_EQ(count(kick_list_section(two.view()), "data-replay="), kMostReplays);
  two.data.kicks.push_back(two.data.kicks.front());
  EXPECT_EQ(count(kick_list_section(two.view()), "data-replay="), 0U);
  EXPECT_EQ(count(kick_list_section(two.view()), "<tr id="), kMostReplays + 1);
}

TEST(ReportPage, BinsAboveFiveThousandKicks) {
  TwoPolicies two;
  two.data.kicks.assign(kMostKicks + 1, {0, kick("moving", "on_target", 0.0, 0.5)});
  const std::string text = to_html(two.report, two.data);
  EXPECT_THAT(text, HasSubstr("Squares of 10 cm"));
  EXPECT_THAT(text, HasSubstr("Squares of 50 cm"));
  EXPECT_THAT(text, HasSubstr("5001 kicks are too many for a list"));
  EXPECT_EQ(count(text, " data-kick="), 0U);
  EXPECT_LT(text.size(), 200'000U);
}

TEST(ReportPage, SaysOnEveryFigureThatDataAreSimulated) {
  TwoPolicies two;
  two.data.kicks.assign(20, {0, kick("moving", "on_target", 0.0, 0.5)});
  two.data.predictions = {{0.85, true}};
  two.data.held = {{"moving", "not_aligned", 400, 30, {}}};
  const std::string measured = to_html(two.report, two.data);
  EXPECT_EQ(count(measured, "simulated: the simulation"), 0U);
  two.report.sessions.resize(1);
  two.report.sessions[0].simulated = true;
  const std::string simulated = to_html(two.report, two.data);
  EXPECT_EQ(count(simulated, "<figure"), 7U);
  EXPECT_EQ(count(simulated, "class=\"simulated\""), 8U);  // and the replay
}

TEST(ReportPage, AsksForNothingAndIsTheSameEachTime) {
  TwoPolicies two;
  two.data.logs[0].name = "</title><script>alert(1)</script>";
  two.data.kicks = {{0, kick("</script><script>alert(2)</script>", "on_target", 0.0, 0.5)}};
  const std::string text = to_html(two.report, two.data);
  EXPECT_EQ(text, to_html(two.report, two.data));
  EXPECT_THAT(text, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_EQ(count(text, "<script"), 2U);
  EXPECT_EQ(count(text, "</script>"), 2U);
  EXPECT_THAT(text, Not(HasSubstr("http://www.w3.org/1999")));
  EXPECT_EQ(count(text, " src="), 0U);
  EXPECT_THAT(text, Not(HasSubstr("unsafe")));
}

}  // namespace
}  // namespace trivela::evaluator::page
