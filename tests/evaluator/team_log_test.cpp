#include "evaluator/imports/team_log.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "evaluator/imports/play_statistics.hpp"
#include "tests/evaluator/team_log_writing.hpp"

namespace trivela::evaluator::imports {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TeamLog read(const std::string& text) {
  std::istringstream in(text);
  return read_team_log(in, "x.A.msl");
}

std::string log_of(const std::vector<std::string>& states, std::int64_t step_ms = 100) {
  std::ostringstream out;
  TeamLogWriting log(out);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto n = static_cast<std::int64_t>(i);
    log.record(1'000'000 + n * step_ms, n * step_ms, states[i]);
  }
  log.close();
  return out.str();
}

/// The faults of one worldstate in a log of it alone.
std::vector<std::string> faults_of(const std::string& state) { return read(log_of({state})).faults.sentences(); }

std::string with_robot(const std::string& robot) { return worldstate(robot, told_ball(1.0)); }

std::string with_ball(const std::string& ball) { return worldstate(told_robot(1, 0.0, 0.0), ball); }

TEST(TeamLog, ARecordOfTheLeaguesSchemaIsReadWithoutAFault) {
  const TeamLog log =
      read(log_of({worldstate(told_robot(1, -1.5, 2.0) + "," + told_robot(2, 0.5, 4.0, "1"), told_ball(0.5))}));
  EXPECT_THAT(log.faults.sentences(), IsEmpty());
  EXPECT_EQ(log.team, "Water");
  ASSERT_EQ(log.usable.size(), 1u);
  const TeamRecord& record = log.usable[0];
  EXPECT_EQ(record.timestamp_ms, 1'000'000.0);
  EXPECT_EQ(record.game_ms, 0.0);
  ASSERT_EQ(record.robots.size(), 2u);
  EXPECT_EQ(record.robots[0].id, 1);
  EXPECT_EQ(record.robots[0].x_m, -1.5);
  EXPECT_EQ(record.robots[0].heading_rad, 0.25);
  EXPECT_THAT(*record.robots[0].velocity, ElementsAre(0.0, 0.5, 0.1));
  EXPECT_FALSE(record.robots[0].ball_engaged);
  EXPECT_TRUE(record.robots[1].ball_engaged);
  ASSERT_TRUE(record.ball);
  EXPECT_EQ(record.ball->x_m, 0.5);
}

TEST(TeamLog, FaultsOfAgesAreNamed) {
  const auto aged = [](const std::string& age) { return worldstate(told_robot(1, 0, 0), told_ball(1), age); };
  EXPECT_THAT(faults_of(aged("4.5")), ElementsAre("x.A.msl: ageMs not whole in record 1: ageMs = 4.5"));
  EXPECT_THAT(faults_of(aged("-1")), ElementsAre("x.A.msl: ageMs negative in record 1: ageMs = -1"));
  EXPECT_THAT(faults_of(aged("600000")), ElementsAre("x.A.msl: ageMs above 10 s in record 1: ageMs = 600000"));
  EXPECT_THAT(faults_of(aged("\"old\"")), ElementsAre("x.A.msl: value of another type in record 1: ageMs = old"));
  std::string without = aged("40");
  without.replace(without.find("\"ageMs\":40,"), 11, "");
  EXPECT_THAT(faults_of(without), ElementsAre("x.A.msl: ageMs missing in record 1"));
}

TEST(TeamLog, FaultsOfRobotsAreNamedAndTheRobotIsUsedWhereItHasAPlace) {
  EXPECT_THAT(faults_of(with_robot(told_robot(1, 0, 0, "0.0"))),
              ElementsAre("x.A.msl: ballEngaged neither 0 nor 1 in record 1: ballEngaged = 0.0"));
  EXPECT_THAT(faults_of(with_robot(told_robot(1, 0, 0, "0", "target pose"))),
              ElementsAre(HasSubstr("key \"target pose\" in record 1")));
  EXPECT_THAT(faults_of(with_robot(told_robot(1, 0, 0) + "," + told_robot(1, 1, 1))),
              ElementsAre("x.A.msl: robot twice in a record in record 1: id = 1"));
  const auto use = [](const std::string& robot) { return read(log_of({with_robot(robot)})).usable[0].robots.size(); };
  const std::string placeless =
      R"({"id":1,"pose":null,"targetPose":[0,0,0],"velocity":null,"intention":"","batteryLevel":5,"ballEngaged":1})";
  EXPECT_THAT(faults_of(with_robot(placeless)), ElementsAre("x.A.msl: null position in record 1: pose = null",
                                                            "x.A.msl: velocity null in record 1: velocity = null"));
  EXPECT_EQ(use(placeless), 0u);
  EXPECT_EQ(use(told_robot(1, 1800.0, 0.0)), 0u);  // millimetres
  EXPECT_THAT(faults_of(with_robot(told_robot(1, 1800.0, 0.0))),
              ElementsAre("x.A.msl: position beyond 50 m in record 1: robot = 1800, 0"));
  EXPECT_EQ(use(R"({"id":2,"pose":[0,0,1]})"), 1u);
  EXPECT_THAT(faults_of(with_robot(R"({"id":300,"pose":[0,0]})")),
              Contains("x.A.msl: robot without an id from 0 to 255 in record 1: id = 300"));
  EXPECT_THAT(faults_of(with_robot(R"({"id":3,"pose":[0,0]})")),
              Contains(HasSubstr("robot with too short a position")));
  EXPECT_EQ(use(R"({"id":3,"pose":[1,5, 2,5, 0,1]})"), 0u);  // a decimal comma
  EXPECT_THAT(faults_of(with_robot(R"({"id":3,"pose":[1,5, 2,5, 0,1]})")),
              Contains(HasSubstr("robot with too long a position in record 1: robot = 1, 5, 2, ... (6 numbers)")));
  EXPECT_THAT(faults_of(with_robot(R"({"id":3,"pose":[1,5,0],"velocity":[0,5,1,0]})")),
              Contains(HasSubstr("robot with too long a velocity in record 1: robot = 0, 5, 1, ... (4 numbers)")));
}

TEST(TeamLog, FaultsOfBallsAreNamedAndTheMostTrustedOneIsUsed) {
  EXPECT_THAT(faults_of(with_ball(told_ball(1.0, 0.0))),
              ElementsAre("x.A.msl: ball at height 0 in record 1: position = 0"));
  EXPECT_THAT(faults_of(with_ball(told_ball(1.0, 0.11, -100.0))),
              ElementsAre("x.A.msl: confidence outside 0..1 in record 1: confidence = -100"));
  EXPECT_THAT(faults_of(with_ball(R"({"position":[null,null,null],"velocity":[0,0,0],"confidence":0.5})")),
              ElementsAre("x.A.msl: null position in record 1: ball"));
  EXPECT_THAT(faults_of(with_ball(R"({"position":[1,2,0.1],"confidence":0.5})")),
              ElementsAre("x.A.msl: ball without velocity in record 1"));
  const TeamLog log = read(log_of(
      {with_ball(told_ball(1.0, 0.11, 0.2) + "," + told_ball(2.0, 0.11, 0.7) + "," + told_ball(3.0, 0.11, 0.5))}));
  EXPECT_THAT(log.faults.sentences(), ElementsAre("x.A.msl: more than one ball in record 1: balls = 3"));
  EXPECT_EQ(log.usable[0].ball->x_m, 2.0);
}

TEST(TeamLog, FaultsOfTheWholeFileAreNamed) {
  const std::vector<std::string> same(150, worldstate(told_robot(1, 0, 0), told_ball(1)));
  EXPECT_THAT(read(log_of(same)).faults.sentences(),
              ElementsAre("x.A.msl: battery constant: batteryLevel of robot 1 = 80"));
  EXPECT_THAT(read(log_of(same, 250)).faults.sentences(),
              Contains("x.A.msl: rate below 10 Hz: records a second = 4.0"));
  EXPECT_NEAR(*record_rate_hz(read(log_of(same, 250))), 4.0, 1e-9);
}

TEST(TeamLog, StampsThatRepeatOrGoBackAreCounted) {
  std::ostringstream out;
  TeamLogWriting writing(out);
  const std::string state = worldstate(told_robot(1, 0, 0), told_ball(1));
  for (const std::int64_t stamp : {1000, 1000, 1000, 900, 1300}) writing.record(stamp, 100 * writing.records(), state);
  writing.close();
  EXPECT_THAT(read(out.str()).faults.sentences(),
              ElementsAre("x.A.msl: repeated stamp: 2 times, first in record 2: timestamp = 1000",
                          "x.A.msl: record out of order in record 4: timestamp = 900"));
}

TEST(TeamLog, ABrokenRecordIsNamedAndTheOthersAreUsed) {
  const std::string good = R"({"teamName": "W","timestamp": 1,"gametimeMs": 1,"worldstate": )" +
                           worldstate(told_robot(1, 0, 0), told_ball(1)) + "}";
  const TeamLog log =
      read("[\n" + good + "\n,\n{\"teamName\": \"W\",\"timestamp\": 1x,\"worldstate\": {}}\n,\n" + good + "\n]");
  EXPECT_EQ(log.records, 3);
  EXPECT_EQ(log.usable.size(), 2u);
  EXPECT_THAT(log.faults.sentences(), Contains("x.A.msl: record is not JSON in record 2"));
}

TEST(TeamLog, ATruncatedFileSaysSoAndWhatIsWholeIsUsed) {
  const std::string whole =
      log_of({worldstate(told_robot(1, 0, 0), told_ball(1)), worldstate(told_robot(1, 0, 0), told_ball(1))});
  for (std::size_t cut = whole.size() - 3; cut > whole.size() / 2 + 5; cut -= 7) {
    const TeamLog log = read(whole.substr(0, cut));
    EXPECT_EQ(log.usable.size(), 1u) << cut;
    EXPECT_THAT(log.faults.sentences(),
                ElementsAre("x.A.msl: breaks off within a record in record 2", "x.A.msl: array not closed"));
  }
}

TEST(TeamLog, TimesBeyondAllMatchesAreLeftOut) {
  const TeamLog log = read(R"([{"timestamp": 1e300,"gametimeMs": -5,"worldstate": {"robots":[]}}])");
  EXPECT_EQ(log.faults.of("time beyond all matches"), 2);
  ASSERT_EQ(log.usable.size(), 1u);
  EXPECT_FALSE(log.usable[0].timestamp_ms);
  EXPECT_FALSE(log.usable[0].game_ms);
  EXPECT_THAT(record_times_ms(log, nullptr), ElementsAre(0));
}

TEST(TeamLog, WhatIsNoLogSaysSo) {
  EXPECT_THAT(read("").faults.sentences(), ElementsAre("x.A.msl: no record in it"));
  EXPECT_THAT(read("[]").faults.sentences(), ElementsAre("x.A.msl: no record in it"));
  EXPECT_THAT(read("hello\n").faults.sentences(), ElementsAre("x.A.msl: not JSON in record 1: line = hello"));
  const TeamLog other = read("[{\"a\":[{\"b\":1}],\"worldstate\":[1,2],\"timestamp\":null}]");
  EXPECT_THAT(other.usable, IsEmpty());
  EXPECT_THAT(other.faults.sentences(), Contains(HasSubstr("worldstate missing in record 1")));
}

TEST(RecordTimes, AreThoseOfTheGameTimePlacedByTheStampsThatMove) {
  std::ostringstream out;
  TeamLogWriting writing(out);
  const std::string state = worldstate(told_robot(1, 0, 0), told_ball(1));
  // Twice the same stamp, one that goes back; then the next part, whose game time starts at 0.
  const std::int64_t stamps[] = {5000, 5000, 5200, 5100, 5400, 9000, 9100};
  const std::int64_t game[] = {1000, 1100, 1200, 1300, 1400, 0, 100};
  for (int i = 0; i < 7; ++i) writing.record(stamps[i], game[i], state);
  writing.close();
  EXPECT_THAT(record_times_ms(read(out.str()), nullptr), ElementsAre(5000, 5100, 5200, 5300, 5400, 9000, 9100));
}

TEST(RecordTimes, OfStampsThatNeverMoveAreThoseOfTheRefereesParts) {
  std::ostringstream out;
  TeamLogWriting writing(out);
  const std::string state = worldstate(told_robot(1, 0, 0), told_ball(1));
  for (const std::int64_t game : {2000, 2250, 100, 350}) writing.record(7, game, state);
  writing.close();
  std::istringstream text(
      "50000,00:01(00:00),1st Half,1,1st half\n60000,00:11(00:10),1st Half - STOP,S,STOP\n"
      "90000,00:00(00:00),2nd Half,2,2nd half\n");
  const RefereeLog referee = read_referee_log(text, "x.msl");
  EXPECT_THAT(record_times_ms(read(out.str()), &referee), ElementsAre(51000, 51250, 90100, 90350));
  EXPECT_THAT(record_times_ms(read(out.str()), nullptr), ElementsAre(2000, 2250, 2250, 2500));
}

TEST(RecordTimes, WhereTheGameTimeStandsStillTheStampsSayTheSteps) {
  std::ostringstream out;
  TeamLogWriting writing(out);
  const std::string state = worldstate(told_robot(1, 0, 0), told_ball(1));
  for (const std::int64_t stamp : {5000, 5100, 5100, 5350}) writing.record(stamp, 0, state);
  writing.close();
  EXPECT_THAT(record_times_ms(read(out.str()), nullptr), ElementsAre(5000, 5100, 5100, 5350));
}

TEST(Possessions, JoinShortGapsAndLeaveOutShortContacts) {
  std::vector<std::string> states;
  for (int i = 0; i < 60; ++i) {
    const bool first = (i >= 5 && i < 10) || (i >= 14 && i < 20);  // 0.5 s of nothing between them
    const bool touch = i >= 30 && i < 33;                          // 0.2 s
    const bool other = i >= 40 && i < 50;
    states.push_back(worldstate(
        told_robot(1, 0, 0, first || touch ? "1" : "0") + "," + told_robot(2, 1, 1, other ? "1" : "0"), told_ball(1)));
  }
  const TeamLog log = read(log_of(states));
  const std::vector<Possession> found = possessions(log, record_times_ms(log, nullptr));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].robot_id, 1);
  EXPECT_DOUBLE_EQ(found[0].duration_s(), 1.4);
  EXPECT_EQ(found[1].robot_id, 2);
  EXPECT_DOUBLE_EQ(found[1].duration_s(), 0.9);
  EXPECT_EQ(found[1].speeds_mps.size(), 10u);
  EXPECT_DOUBLE_EQ(found[1].speeds_mps[0], 0.5);
}

TEST(TeamLog, AGeneratedLogWithTheFaultsOfRealClientsIsCountedRecordByRecord) {
  std::stringstream text;
  const GeneratedFaults made = write_faulty_log(text, 1'000'000);
  const TeamLog log = read_team_log(text, "x.A.msl");
  EXPECT_EQ(log.records, made.records);
  EXPECT_EQ(std::ssize(log.usable), made.records);
  EXPECT_EQ(log.faults.of("ageMs missing"), made.no_age);
  EXPECT_EQ(log.faults.of("more than one ball"), made.five_balls);
  EXPECT_EQ(log.faults.of("null position"), made.null_positions);
  EXPECT_EQ(log.faults.of("ball at height 0"), made.records + 3 * made.five_balls);
  EXPECT_EQ(log.faults.of("battery constant"), 1);
  EXPECT_GT(log.faults.of("repeated stamp"), made.records / 3);
  EXPECT_GT(log.faults.of("record out of order"), made.records / 20);
  const auto found = possessions(log, record_times_ms(log, nullptr));
  ASSERT_EQ(std::ssize(found), (made.records + 89) / 100);
  EXPECT_NEAR(found[0].duration_s(), 1.0, 1e-9);
}

TEST(TeamLog, ArraysWithoutEndAreAFaultAndNoMemory) {
  std::istringstream in(std::string(1'000'000, '['));
  const TeamLog log = read_team_log(in, "x.A.msl");
  EXPECT_TRUE(log.usable.empty());
  std::istringstream deep("{\"worldstate\":" + std::string(1'000'000, '[') + "}");
  EXPECT_THAT(read_team_log(deep, "x.A.msl").faults.sentences(), Contains(HasSubstr("record is not JSON")));
}

/// Every place of a record with every kind of JSON value in it, one at a time.
TEST(TeamLog, WhateverStandsInOnePlaceItIsReadOrAFaultAndNoNumberIsTakenForAnother) {
  using nlohmann::json;
  const json whole =
      json::parse(log_of({worldstate(told_robot(1, -1.5, 2.0) + "," + told_robot(2, 0.5, 4.0, "1"), told_ball(0.5))}));
  const std::vector<std::string> values{"null",
                                        "true",
                                        "0",
                                        "-1",
                                        "256",
                                        "1e308",
                                        "-0.5",
                                        "1.5e9",
                                        "\"\"",
                                        "\"1,5\"",
                                        "\"7\"",
                                        "[]",
                                        "[0]",
                                        "[1,2]",
                                        "[1,2,3]",
                                        "[1,2,3,4]",
                                        "[[1],2,3]",
                                        "[null,1,2]",
                                        "{}",
                                        "{\"x\":1}",
                                        "9223372036854775808",
                                        "\"" + std::string(3000, 'x') + "\""};
  std::size_t faults = 0, cases = 0;
  const json places = whole.flatten();
  for (const auto& [place, unused] : places.items()) {
    for (json::json_pointer at{place}; !at.empty(); at = at.parent_pointer()) {
      for (const std::string& value : values) {
        json changed = whole;
        changed[at] = json::parse(value);
        const TeamLog log = read(changed.dump());
        ++cases;
        faults += log.faults.sentences().empty() ? 0 : 1;
        for (const TeamRecord& record : log.usable) {
          for (const ReportedRobot& robot : record.robots) {
            ASSERT_TRUE(robot.id >= 0 && robot.id <= 255) << at << " " << value;
            ASSERT_TRUE(std::abs(robot.x_m) <= 50.0 && std::abs(robot.y_m) <= 50.0) << at << " " << value;
            ASSERT_LT(std::abs(robot.heading_rad), 3.2) << at << " " << value;
          }
        }
        record_times_ms(log, nullptr);
      }
    }
  }
  EXPECT_GT(faults, cases / 2);
}

}  // namespace
}  // namespace trivela::evaluator::imports
