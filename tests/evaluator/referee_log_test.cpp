#include "evaluator/imports/referee_log.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "evaluator/imports/play_statistics.hpp"

namespace trivela::evaluator::imports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RefereeLog read(const std::string& text) {
  std::istringstream in(text);
  return read_referee_log(in, "x.msl");
}

RefereeLog match_of_2018() {
  std::ifstream in(std::string(TRIVELA_SOURCE_DIR) + "/tests/data/refbox/20180618_085311.msl");
  EXPECT_TRUE(in);
  return read_referee_log(in, "20180618_085311.msl");
}

TEST(RefereeLog, OfARealMatchIsReadWithoutAFault) {
  const RefereeLog log = match_of_2018();
  EXPECT_THAT(log.faults.sentences(), IsEmpty());
  EXPECT_EQ(log.lines.size(), 170u);
  EXPECT_EQ(log.accepted, 5);
  EXPECT_EQ(log.dropped, 4);
  EXPECT_EQ(log.refused, 2);
  const RefereeLine& third = log.lines[2];
  EXPECT_EQ(third.t_ms, 1529326813081);
  EXPECT_EQ(third.game_ms, 421'000);
  EXPECT_EQ(third.run_ms, 0);
  EXPECT_EQ(third.state, "1st Half");
  EXPECT_EQ(third.command, BoxCommand::kStart);
  EXPECT_EQ(log.lines[0].side, BoxSide::kMagenta);
}

// The values of this log as they were measured by another program.
TEST(PlayStatistics, OfARealMatchAreThoseThatWereMeasured) {
  const PlayStatistics s = play_statistics(match_of_2018());
  EXPECT_EQ(s.plays.size(), 33u);
  EXPECT_NEAR(s.played_s() / 33.0, 15.3, 0.05);
  std::vector<double> lengths_s;
  for (const Play& play : s.plays) lengths_s.push_back(1e-3 * static_cast<double>(play.to_ms - play.from_ms));
  EXPECT_NEAR(*median(lengths_s), 13.0, 0.05);
  EXPECT_NEAR(*s.stops_per_min(), 3.9, 0.05);
  EXPECT_NEAR(*median(s.stop_to_start_s), 40.0, 0.5);
  EXPECT_NEAR(*median(s.restart_to_start_s), 8.8, 0.05);
  EXPECT_EQ(s.open_plays, 0);
}

TEST(RefereeLog, CommandsOfJsonAreThoseOfLettersAndKnowTheSideOfAnAcceptedTeam) {
  const RefereeLog log = read(
      "Connection from 172.16.39.27 accepted - Magenta\n"
      "1000,00:01(00:00),Pre-Game,{\"command\":\"KICKOFF\",\"targetTeam\":\"224.16.32.39\"},null\n"
      "1000,00:01(00:00),Pre-Game,{\"targetTeam\":\"224.16.32.7\",\"command\":\"THROWIN\"},null\n"
      "1000,00:01(00:00),Pre-Game,{\"command\":\"GAME_OVER\",\"targetTeam\":\"\"},Game over, at last\n");
  EXPECT_THAT(log.faults.sentences(), IsEmpty());
  ASSERT_EQ(log.lines.size(), 3u);
  EXPECT_EQ(log.lines[0].command, BoxCommand::kKickOff);
  EXPECT_EQ(log.lines[0].side, BoxSide::kMagenta);
  EXPECT_EQ(log.lines[1].side, BoxSide::kBoth);
  EXPECT_EQ(log.lines[2].command, BoxCommand::kGameOver);
  EXPECT_EQ(log.lines[2].text, "Game over, at last");
}

TEST(RefereeLog, FaultsAreCountedByNameWithTheirFirstPlaceAndTheRestIsUsed) {
  const RefereeLog log = read(
      "2000,00:02(00:00),1st Half,s,START\r\n"
      "1500,00:03(00:01),1st Half - STOP,S,STOP\n"
      "3000,00:03(00:01),1st Half,q,What\n"
      "3000,00:03(00:01),1st Half,{\"status\":\"connected\"},null\n"
      "3000,00:03(00:01),1st Half,{\"command\":,null\n"
      "3000,00:99(00:01),1st Half,s,START\n"
      "99999999999999,00:09(00:01),1st Half,s,START\n"
      "hello\n"
      "3000,00:03(00:01),1st Ha");
  EXPECT_THAT(log.faults.sentences(),
              ElementsAre("x.msl: time goes back in line 2: ms = 1500", "x.msl: unknown command in line 3: code = q",
                          "x.msl: object without command in line 4: code = {\"status\":\"connected\"}",
                          HasSubstr("command is not JSON in line 5"),
                          HasSubstr("line of another form: 3 times, first in line 6: line = 3000,00:99"),
                          "x.msl: line breaks off in line 9: line = 3000,00:03(00:01),1st Ha"));
  ASSERT_EQ(log.lines.size(), 2u);
  EXPECT_EQ(log.lines[1].t_ms, 2000);
}

RefereeLog recorded(const std::string& name) {
  std::ifstream in(std::string(TRIVELA_SOURCE_DIR) + "/tests/data/refbox/" + name);
  EXPECT_TRUE(in);
  return read_referee_log(in, name);
}

TEST(RefereeLog, ReadsTheWordsOfTheBoxesSince2020WithTheirTeams) {
  const RefereeLog log = recorded("20240719_101500.msl");
  EXPECT_THAT(log.faults.sentences(), IsEmpty());
  ASSERT_EQ(log.lines.size(), 24u);
  const std::vector<std::pair<BoxCommand, BoxSide>> begin{
      {BoxCommand::kWelcome, BoxSide::kCyan},    {BoxCommand::kKickOff, BoxSide::kCyan},
      {BoxCommand::kFirstHalf, BoxSide::kBoth},  {BoxCommand::kStart, BoxSide::kBoth},
      {BoxCommand::kStop, BoxSide::kBoth},       {BoxCommand::kThrowIn, BoxSide::kMagenta},
      {BoxCommand::kStart, BoxSide::kBoth},      {BoxCommand::kStop, BoxSide::kBoth},
      {BoxCommand::kGoal, BoxSide::kCyan},       {BoxCommand::kRepair, BoxSide::kMagenta},
      {BoxCommand::kYellowCard, BoxSide::kCyan}, {BoxCommand::kKickOff, BoxSide::kMagenta}};
  for (std::size_t i = 0; i < begin.size(); ++i) {
    EXPECT_EQ(log.lines[i].command, begin[i].first) << i;
    EXPECT_EQ(log.lines[i].side, begin[i].second) << i;
  }
  EXPECT_EQ(log.lines.back().command, BoxCommand::kPark);
}

TEST(RefereeLog, AClockThatIsSetDuringTheMatchIsOneFaultAndCostsNoTime) {
  const RefereeLog forward = recorded("clock_set_forward.msl");
  EXPECT_THAT(forward.faults.sentences(), ElementsAre("clock_set_forward.msl: clock set in line 6: s = 3600"));
  EXPECT_NEAR(play_statistics(forward).played_s(), 75.4, 0.01);
  for (const int set_s : {-3600, -40, 40, 86'400}) {
    std::string text;
    for (int i = 0; i < 5; ++i)
      text += std::to_string(1'000'000'000LL + 10'000 * i + (i >= 3 ? 1000LL * set_s : 0)) +
              ",00:" + std::to_string(10 + 10 * i) + "(00:10),1st Half,s,START\n";
    const RefereeLog log = read(text);
    EXPECT_THAT(log.faults.sentences(), ElementsAre("x.msl: clock set in line 4: s = " + std::to_string(set_s)));
    EXPECT_EQ(log.lines.back().t_ms, 1'000'040'000);
  }
}

TEST(RefereeLog, AByteOrderMarkCostsNoCommand) {
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "0,00:00(00:00),1st Half,s,START\n")
                .lines.size(),
            1u);
}

TEST(RefereeLog, AnEmptyFileSaysSo) {
  EXPECT_THAT(read("").faults.sentences(), ElementsAre("x.msl: no command in it"));
}

TEST(PlayStatistics, APlayEndsWithItsPartAndOneThatNothingEndsIsNotCounted) {
  const PlayStatistics s =
      play_statistics(read("0,00:00(00:00),1st Half,s,START\n"
                           "10000,00:10(00:10),1st Half,s,START\n"
                           "30000,00:30(00:30),Halftime,h,Halftime\n"
                           "40000,00:00(00:00),2nd Half,2,2nd half\n"
                           "50000,00:10(00:00),2nd Half,K,CYAN Kickoff\n"
                           "52000,00:12(00:00),2nd Half - STOP,S,STOP\n"
                           "60000,00:20(00:00),2nd Half,N,Drop Ball\n"
                           "63000,00:23(00:00),2nd Half,s,START\n"
                           "66000,00:26(00:03),2nd Half - STOP,S,STOP\n"
                           "70000,00:30(00:03),2nd Half,s,START\n"));
  ASSERT_EQ(s.plays.size(), 2u);
  EXPECT_EQ(s.plays[0].to_ms, 30'000);
  EXPECT_FALSE(s.plays[0].stopped);
  EXPECT_EQ(s.plays[1].part, 2);
  EXPECT_EQ(s.open_plays, 1);
  EXPECT_DOUBLE_EQ(*s.stops_per_min(), 60.0 * 1 / 33.0);
  EXPECT_THAT(s.stop_to_start_s, ElementsAre(4.0));
  EXPECT_THAT(s.restart_to_start_s, ElementsAre(3.0));
}

TEST(PlayStatistics, OfALogWithoutPlayHasNoRates) {
  const PlayStatistics s = play_statistics(read("0,00:00(00:00),1st Half - STOP,S,STOP\n"));
  EXPECT_FALSE(s.stops_per_min());
  EXPECT_FALSE(median(s.stop_to_start_s));
  EXPECT_FALSE(mean({}));
  EXPECT_FALSE(quantile({}, 0.95));
}

TEST(BoxCommand, EveryNameLeadsBackToItsCommand) {
  for (int i = 0; i <= static_cast<int>(BoxCommand::kIsAlive); ++i) {
    const auto command = static_cast<BoxCommand>(i);
    EXPECT_EQ(refbox::kind_of(name(command)), command);
  }
  EXPECT_EQ(refbox::kind_of(" WELCOME"), BoxCommand::kWelcome);
  EXPECT_EQ(refbox::kind_of("HELLO"), std::nullopt);
  EXPECT_EQ(refbox::kind_of("Throw In"), BoxCommand::kThrowIn);
  EXPECT_EQ(refbox::kind_of("Test Mode off"), BoxCommand::kTestModeOff);
  EXPECT_EQ(refbox::kind_of("Overtime 2nd half"), BoxCommand::kSecondHalfOvertime);
  EXPECT_EQ(refbox::kind_of("Goal-"), BoxCommand::kSubGoal);
  EXPECT_EQ(refbox::kind_of("Goal"), BoxCommand::kGoal);
  EXPECT_EQ(refbox::kind_of(""), std::nullopt);
  EXPECT_EQ(side_of(refbox::word_of_letter('T')->team), BoxSide::kCyan);
  EXPECT_EQ(side_of(refbox::word_of_letter('t')->team), BoxSide::kMagenta);
  EXPECT_EQ(side_of(refbox::word_of_letter('s')->team), BoxSide::kBoth);
  EXPECT_FALSE(refbox::word_of_letter('q'));
}

}  // namespace
}  // namespace trivela::evaluator::imports
