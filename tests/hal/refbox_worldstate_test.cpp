#include "hal/refbox/worldstate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "hal/refbox/words.hpp"
#include "tests/hal/json_schema.hpp"

namespace trivela::hal::refbox {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

json schema() {
  std::ifstream file(TRIVELA_SOURCE_DIR "/tests/hal/worldstate.schema.json");
  return json::parse(file);
}

msg::WorldState belief() {
  msg::WorldState robot{};
  robot.robot_id = 3;
  robot.t_ns = 5'000'000'000;
  robot.x_m = 1.5;
  robot.y_m = -2.0;
  robot.heading_rad = std::numbers::pi / 2;
  robot.vx_mps = 0.25;
  robot.vy_mps = 2.0;
  robot.omega_radps = -0.5;
  robot.ball_known = true;
  robot.ball_x_m = 1.0;
  robot.ball_y_m = 3.0;
  robot.ball_vx_mps = 4.0;
  robot.ball_vy_mps = 5.0;
  robot.ball_age_s = 0.25;
  robot.possession = true;
  return robot;
}

json told(const std::vector<msg::WorldState>& robots, std::int64_t now_ns = 5'123'900'000,
          const std::string& team = "Trivela") {
  const std::string text = worldstate_object(robots, {team, "attack"}, now_ns);
  EXPECT_EQ(text.find('\0'), std::string::npos);
  EXPECT_LT(text.size(), kLongestObject_B);
  const json object = json::parse(text);
  EXPECT_THAT(tests::SchemaCheck::problems(object, schema()), IsEmpty()) << text;
  return object;
}

TEST(RefboxWorldstate, SaysPoseVelocityOverGroundAndBallInTheFieldsFrame) {
  const json object = told({belief()});
  EXPECT_EQ(object["teamName"], "Trivela");
  EXPECT_EQ(object["ageMs"], 123) << "a whole number of milliseconds";
  const json& robot = object["robots"].at(0);
  EXPECT_EQ(robot["id"], 3);
  EXPECT_EQ(robot["pose"], json({1.5, -2.0, std::numbers::pi / 2}));
  // Facing -x, forward is -x and right is +y.
  EXPECT_NEAR(robot["velocity"].at(0).get<double>(), -2.0, 1e-12);
  EXPECT_NEAR(robot["velocity"].at(1).get<double>(), 0.25, 1e-12);
  EXPECT_EQ(robot["velocity"].at(2), -0.5);
  EXPECT_EQ(robot["ballEngaged"], 1);
  const json& ball = object["balls"].at(0);
  EXPECT_EQ(ball["position"], json({1.0, 3.0, nullptr}));
  EXPECT_EQ(ball["velocity"], json({4.0, 5.0, nullptr}));
  EXPECT_EQ(ball["confidence"], 0.75);
}

TEST(RefboxWorldstate, WithoutARobotIsStillAnObjectOfTheLeague) {
  const json object = told({});
  EXPECT_THAT(object["robots"], IsEmpty());
  EXPECT_EQ(object["ageMs"], 0);
}

TEST(RefboxWorldstate, WhatIsNotKnownIsNullOrLeftOut) {
  msg::WorldState robot = belief();
  robot.ball_known = false;
  robot.ball_age_s = robot.ball_x_m = kNaN;
  robot.possession = false;
  robot.x_m = kNaN;
  json object = told({robot});
  EXPECT_THAT(object["balls"], IsEmpty());
  EXPECT_TRUE(object["robots"].at(0)["pose"].at(0).is_null());
  EXPECT_EQ(object["robots"].at(0)["ballEngaged"], 0);
  robot.ball_known = true;
  robot.ball_age_s = 7.0;
  object = told({robot});
  EXPECT_EQ(object["balls"].at(0)["confidence"], 0.0);
}

TEST(RefboxWorldstate, ItsAgeIsOfTheNewestBeliefAndNeverNegative) {
  msg::WorldState older = belief();
  older.robot_id = 1;
  older.t_ns -= 1'000'000'000;
  EXPECT_EQ(told({older, belief()})["ageMs"], 123);
  EXPECT_EQ(told({belief()}, 0)["ageMs"], 0);
}

TEST(RefboxWorldstate, ANameThatIsNoTextIsMarked) {
  EXPECT_EQ(told({belief()}, 0, "Team \"\xff\"\n")["teamName"], "Team \"\xEF\xBF\xBD\"\n");
}

TEST(RefboxWorldstate, TheSchemaRefusesWhatRealClientsSent) {
  const auto problems = [](const std::function<void(json&)>& spoil) {
    json object = json::parse(worldstate_object(std::vector{belief()}, {"a", "b"}, 0));
    spoil(object);
    return tests::SchemaCheck::problems(object, schema());
  };
  EXPECT_THAT(problems([](json&) {}), IsEmpty());
  EXPECT_THAT(problems([](json& o) { o.erase("ageMs"); }), ElementsAre("object has no \"ageMs\""));
  EXPECT_THAT(problems([](json& o) { o["ageMs"] = 12.5; }), ElementsAre("object.ageMs is no \"integer\""));
  EXPECT_THAT(problems([](json& o) { o["robots"][0]["target pose"] = 1; }),
              ElementsAre("object.robots[0] has a key \"target pose\" that nobody knows"));
  EXPECT_THAT(problems([](json& o) { o["balls"][0]["confidence"] = -100; }),
              ElementsAre("object.balls[0].confidence is below 0"));
  EXPECT_THAT(problems([](json& o) {
                o["robots"][0]["pose"] = {1, 2};
              }),
              ElementsAre("object.robots[0].pose is too short"));
  EXPECT_THAT(problems([](json& o) { o["type"] = "world"; }), ElementsAre("object.type is none of [\"worldstate\"]"));
}

}  // namespace
}  // namespace trivela::hal::refbox
