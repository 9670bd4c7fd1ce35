#include "pages/monitor/match_scene.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/pages/kicks_of_a_match.hpp"

namespace trivela::pages {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart = 1'000'000 * kMs;

/// A match of one robot, whose nodes write each 20 ms while the test lets time go by.
class Scene : public testing::Test {
 protected:
  std::vector<std::string> alarms() const {
    std::vector<std::string> texts;
    for (const auto& [name, alarm] : scene.state().alarms.alarms()) texts.push_back(alarm.text);
    return texts;
  }
  json pitch() const { return json::parse(pitch_json(scene.state(), now)); }
  json match() const { return json::parse(match_json(scene.state(), now)); }
  json robot() const { return pitch()["robots"][0]; }

  /// What is written in a cycle, unless the test takes something out or adds to it.
  void cycle() {
    ++seq;
    now += 20 * kMs;
    if (speaks.world) scene.receive(world(1, ++numbers.world, playing, possession), 1, now);
    if (speaks.referee) scene.receive(referee(1, ++numbers.referee, playing), 2, now);
    if (speaks.kicker) scene.receive(kicker(1, ++numbers.kicker, armed), 3, now);
    if (seq % 5 == 0) scene.look(now);
  }
  void play(std::int64_t ms) {
    for (const std::int64_t end = now + ms * kMs; now < end;) cycle();
  }

  MatchScene scene{SceneSettings{.title = "us"}};
  struct {
    bool world = true, referee = true, kicker = true;
  } speaks;
  bool playing = true, possession = false, armed = true;
  std::uint64_t seq = 0;
  struct {
    std::uint64_t world = 0, referee = 0, kicker = 0;
  } numbers;
  std::int64_t now = kStart;
};

TEST_F(Scene, OfARobotThatIsWellHasNoAlarm) {
  play(5000);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_THAT(match()["mended"], IsEmpty());
}

TEST_F(Scene, HasNothingOfNobody) {
  scene.look(now);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_THAT(pitch()["robots"], IsEmpty());
  EXPECT_EQ(match()["referee"], nullptr);
}

TEST_F(Scene, AStreamThatFallsSilentIsAnAlarmUntilItIsHeardAgain) {
  play(1000);
  speaks.kicker = false;
  play(400);
  EXPECT_THAT(alarms(), IsEmpty()) << "a busy machine is no fault";
  play(600);
  EXPECT_THAT(alarms(), ElementsAre("robot 1: no kicker_status is received any more"));
  speaks.kicker = true;
  play(200);
  EXPECT_THAT(alarms(), IsEmpty());
  const json mended = match()["mended"];
  ASSERT_EQ(mended.size(), 1u);
  EXPECT_EQ(mended[0]["text"], "robot 1: no kicker_status is received any more");
  EXPECT_GT(mended[0]["to_ms"], mended[0]["from_ms"]);
}

TEST_F(Scene, APageThatStandsStillCallsNobodySilent) {
  play(1000);
  now += 5'000'000'000;
  scene.look(now);
  EXPECT_THAT(alarms(), IsEmpty());
}

TEST_F(Scene, ARefereeWhoFallsSilentIsNamed) {
  play(1000);
  speaks.referee = false;
  play(1500);
  EXPECT_THAT(alarms(), ElementsAre("robot 1: the referee is silent"));
}

TEST_F(Scene, WithoutARefereeFromTheBeginningSaysSo) {
  speaks.referee = false;
  play(200);
  EXPECT_THAT(alarms(), ElementsAre("no referee has been received"));
}

TEST_F(Scene, ARobotOfWhichEverythingIsSilentIsOneAlarmAndKeepsItsPlaceOnTheField) {
  play(1000);
  speaks = {false, false, false};
  play(3000);
  EXPECT_THAT(alarms(), ElementsAre("robot 1 is silent"));
  EXPECT_EQ(robot()["fresh"], false);
  EXPECT_EQ(robot()["x"], 1.0);
  EXPECT_EQ(robot()["why"], "no world_state is received");
}

TEST_F(Scene, AfterTheMatchSilenceIsNoAlarm) {
  play(1000);
  speaks = {false, false, false};
  scene.note_over();
  play(5000);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_EQ(match()["over"], true);
}

TEST_F(Scene, ShowsWhatKicksHaveShownOfAKickerOnceThereIsOne) {
  msg::KickerEstimate estimate{};
  estimate.robot_id = 1;
  estimate.seq = 1;
  scene.receive(estimate, 4, now);
  play(100);
  EXPECT_TRUE(robot()["learned"].is_null()) << "before the first kick";
  estimate.seq = 2;
  estimate.kicks = 1;
  estimate.used = true;
  estimate.speed_ln = std::log(1.1);
  estimate.speed_ln_se = 0.02;
  scene.receive(estimate, 4, now);
  play(60'000);
  const json learned = robot()["learned"];
  EXPECT_EQ(learned["kicks"], 1) << "it holds until there is another one";
  EXPECT_EQ(learned["used"], true);
  EXPECT_NEAR(learned["speed_percent"], 10.0, 0.01);
  EXPECT_NEAR(learned["speed_se_percent"], 2.0, 0.01);
}

TEST_F(Scene, AFaultOfTheKickerIsAnAlarm) {
  play(1000);
  msg::KickerStatus faulty = kicker(1, ++numbers.kicker);
  faulty.state = msg::STATE_FAULT;
  faulty.fault = msg::FAULT_CHARGER;
  scene.receive(faulty, 3, now);
  scene.look(now);
  EXPECT_THAT(alarms(), ElementsAre("robot 1: kicker: fault of the charger"));
  play(200);
  EXPECT_THAT(alarms(), IsEmpty());
}

msg::KickerDrift drift(double factor, msg::DriftKind kind = msg::DRIFT_EXIT_SPEED) {
  msg::KickerDrift said{};
  said.robot_id = 1;
  said.seq = 1;
  said.changes = 1;
  said.changed_kick_id = 61;
  said.found_kick_id = 66;
  said.kind = kind;
  said.factor = factor;
  said.factor_se = 0.008;
  said.height_m = -0.42;
  return said;
}

TEST_F(Scene, AKickerThatChangedIsAnAlarmThatSaysByHowMuchAndWhatToDo) {
  scene.receive(drift(0.95), 4, now);
  play(20'000);
  EXPECT_THAT(
      alarms(),
      ElementsAre("robot 1: its kicker changed at kick 61: exit speed fell by 5.0 % (standard error 0.8); multiply "
                  "exit_speeds_mps of its [table] by 0.950, or measure it again: trivela calibrate table"))
      << "it holds without being said again";
  msg::KickerDrift taken_back{};
  taken_back.robot_id = 1;
  taken_back.seq = 2;
  scene.receive(taken_back, 4, now);
  play(200);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_EQ(match()["mended"].size(), 1u);
}

TEST_F(Scene, AnAngleThatChangedIsSaidInMetres) {
  scene.receive(drift(0.95, msg::DRIFT_ELEVATION), 4, now);
  play(200);
  EXPECT_THAT(alarms(),
              ElementsAre(AllOf(HasSubstr("balls cross 0.42 m lower"), HasSubstr("measure exit_angle_deg again"))));
}

TEST_F(Scene, AChangeWithoutASizeIsAnAlarmAllTheSame) {
  for (const double factor : {std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0, 1.0}) {
    scene.receive(drift(factor), 4, now);
    play(200);
    EXPECT_THAT(alarms(), ElementsAre("robot 1: its kicker changed at kick 61: by how much is not said")) << factor;
  }
}

TEST_F(Scene, AnOpenSwitchIsAnAlarmOnceTheGameIsPlayedForHalfASecond) {
  playing = armed = false;
  play(2000);
  EXPECT_THAT(alarms(), IsEmpty()) << "no kicker is armed while the game stands";
  playing = true;
  play(300);
  EXPECT_THAT(alarms(), IsEmpty()) << "the driver needs a cycle";
  play(500);
  EXPECT_THAT(alarms(), ElementsAre("robot 1: the arm switch is open"));
  armed = true;
  play(200);
  EXPECT_THAT(alarms(), IsEmpty());
}

TEST_F(Scene, ADeviceThatSaysItsSwitchIsOpenIsBelievedAtOnce) {
  playing = false;
  play(1000);
  msg::DeviceKicker device{};
  device.robot_id = 1;
  device.seq = 1;
  scene.receive(device, 4, now);
  scene.look(now);
  EXPECT_THAT(alarms(), ElementsAre("robot 1: the arm switch is open"));
}

TEST_F(Scene, MissedMessagesAreAnAlarmForTenSecondsAndCounted) {
  play(1000);
  numbers.kicker += 3;
  numbers.referee += 1;
  cycle();
  scene.look(now);
  EXPECT_THAT(alarms(), UnorderedElementsAre("robot 1: this page missed 3 messages of kicker_status",
                                             "robot 1: this page missed a message of referee"));
  EXPECT_EQ(match()["missed"], 4);
  play(11'000);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_EQ(match()["missed"], 4);
}

TEST_F(Scene, UnknownOutcomesAreAnAlarmUntilKnownOnesOutweighThem) {
  play(100);
  const auto kick = [this](std::int64_t id, msg::Outcome what) {
    scene.receive(decision(1, id, msg::POLICY_MOVING, static_cast<std::uint64_t>(id)), 5, now);
    scene.receive(outcome(1, id, what, static_cast<std::uint64_t>(id)), 6, now);
    scene.look(now);
  };
  kick(1, msg::OUTCOME_UNKNOWN);
  kick(2, msg::OUTCOME_UNKNOWN);
  EXPECT_THAT(alarms(), IsEmpty());
  kick(3, msg::OUTCOME_UNKNOWN);
  EXPECT_THAT(alarms(), ElementsAre("3 of the last 3 kicks have no known outcome"));
  for (std::int64_t id = 4; id <= 12; ++id) kick(id, msg::OUTCOME_ON_TARGET);
  EXPECT_THAT(alarms(), IsEmpty());
  EXPECT_EQ(match()["table"]["rows"][0]["unknown"], 3) << "and they stay counted";
}

TEST_F(Scene, SaysWhyARobotHoldsOrFires) {
  play(100);
  EXPECT_EQ(robot()["why"], "it does not have the ball");
  possession = true;
  play(100);
  EXPECT_EQ(robot()["why"], "it has the ball, and no decision is received");
  scene.receive(decision(1, 0, msg::POLICY_MOVING, 1), 5, now);
  EXPECT_EQ(robot()["fires"], false);
  EXPECT_EQ(robot()["why"], "the two segments do not meet");
  EXPECT_EQ(robot()["policy"], "moving");
  scene.receive(decision(1, 9, msg::POLICY_MOVING, 2), 5, now);
  scene.receive(decision(1, 0, msg::POLICY_MOVING, 3), 5, now + 20 * kMs);
  EXPECT_EQ(robot()["fires"], true) << "long enough for an eye";
  msg::KickDecision next = decision(1, 0, msg::POLICY_MOVING, 4);
  next.possession_id = 1;
  scene.receive(next, 5, now + 40 * kMs);
  EXPECT_EQ(robot()["fires"], false) << "it has the ball again";
  playing = possession = false;
  play(1200);
  EXPECT_EQ(robot()["fires"], false);
  EXPECT_EQ(robot()["why"], "the referee has stopped the game");
}

TEST_F(Scene, EveryReasonHasItsOwnWords) {
  std::set<std::string> words;
  for (int reason = msg::REASON_FIRE; reason <= msg::REASON_OWN_HALF; ++reason)
    words.insert(words_of(static_cast<msg::DecisionReason>(reason)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(msg::REASON_OWN_HALF) + 1);
  EXPECT_THAT(words_of(static_cast<msg::DecisionReason>(99)), HasSubstr("does not know"));
}

TEST_F(Scene, DrawsBothSegmentsWhereTheDecisionHasThem) {
  play(100);
  msg::KickDecision aimed = decision(1, 0, msg::POLICY_MOVING);  // from (0, 4) straight at the goal's middle
  aimed.aligned = true;
  aimed.offset_right_m = 0.0;
  aimed.left_m = 0.8;
  aimed.right_m = 1.2;
  scene.receive(aimed, 5, now);
  const json segments = robot()["segments"];
  EXPECT_EQ(segments["s1"], json::parse("[[0.0,4.0],[0.0,9.0]]"));
  EXPECT_EQ(segments["s2"], json::parse("[[-0.8,9.0],[1.2,9.0]]"));
  EXPECT_EQ(segments["meet"], true);
}

TEST_F(Scene, WhatIsNoNumberIsNull) {
  play(100);
  msg::WorldState lost = world(1, ++numbers.world, true, true);
  lost.x_m = std::numeric_limits<double>::quiet_NaN();
  lost.heading_rad = std::numeric_limits<double>::infinity();
  lost.ball_x_m = 1e300;
  scene.receive(lost, 1, now);
  msg::KickDecision empty = decision(1, 0, static_cast<msg::Policy>(200));
  empty.target_x_m = empty.distance_m = empty.power = msg::kNone;
  scene.receive(empty, 5, now);
  EXPECT_EQ(robot()["x"], nullptr);
  EXPECT_EQ(robot()["heading"], nullptr);
  EXPECT_EQ(robot()["policy"], "invalid");
  EXPECT_EQ(robot()["power"], nullptr);
}

TEST_F(Scene, IsSimulatedOnceAnybodySaysSoAndStaysIt) {
  play(100);
  EXPECT_THAT(match()["simulated"], IsEmpty());
  msg::DeviceEmulated word{};
  word.robot_id = 1;
  word.part = msg::PART_KICKER;
  scene.receive(word, 7, now);
  scene.note_members({"simulator"}, {"a simulator"});
  scene.note_members({}, {});
  EXPECT_THAT(match()["simulated"].get<std::vector<std::string>>(), ElementsAre("a simulator", "an emulated kicker"));
}

TEST_F(Scene, ListensToNoTruth) {
  EXPECT_FALSE(MatchScene::listens_to<msg::KickTruth>());
  EXPECT_FALSE(MatchScene::listens_to<msg::PossessionTruth>());
  EXPECT_TRUE(MatchScene::listens_to<msg::KickOutcome>());
}

TEST_F(Scene, ShowsNoMoreRobotsThanItHasPlacesForAndNoRobotZero) {
  for (int id = 0; id <= 200; ++id) scene.receive(world(static_cast<std::uint8_t>(id), 1), 1, now);
  scene.look(now);
  EXPECT_EQ(pitch()["robots"].size(), MatchScene::kMostRobots);
  EXPECT_EQ(pitch()["robots"][0]["id"], 1);
  EXPECT_THAT(alarms(), testing::Contains(HasSubstr("more than 16 robots")));
}

TEST_F(Scene, NamesThatAreNoUtf8AreStillJson) {
  const MatchScene named{SceneSettings{.title = "\xff<b>", .names = {{1, "</script>\xc3"}}}};
  const json shown = json::parse(match_json(named.state(), now));
  EXPECT_EQ(shown["title"], "\uFFFD<b>");
  EXPECT_EQ(shown["names"]["1"], "</script>\uFFFD");
}

TEST_F(Scene, TheMatchIsTheSameTextWhileNothingChanges) {
  play(1000);
  const std::string before = match_json(scene.state(), now);
  play(1000);
  EXPECT_EQ(match_json(scene.state(), now), before);
}

}  // namespace
}  // namespace trivela::pages
