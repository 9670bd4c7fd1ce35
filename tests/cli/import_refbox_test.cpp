#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/log_fixture.hpp"
#include "tests/evaluator/team_log_writing.hpp"
#include "tests/evaluator/zip_writing.hpp"

namespace trivela::cli {
namespace {

using log::Reader;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

namespace imports = evaluator::imports;

const std::string kMatchOf2018 = std::string(TRIVELA_SOURCE_DIR) + "/tests/data/refbox/20180618_085311.msl";

/// Ten seconds of a game that begins at 1000 s, UTC: STOP at 8 s.
const char* const kShortGame =
    "1000000,00:00(00:00),1st Half,1,1st half\n1001000,00:01(00:00),1st Half,K,CYAN Kickoff\n"
    "1002000,00:02(00:00),1st Half,s,START\n1008000,00:08(00:06),1st Half - STOP,S,STOP\n";

class ImportRefbox : public evaluator::LogTest {
 protected:
  static VerbRun run(const std::string& words) { return run_verbs({add_import, add_report}, words); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name).string();
  }

  /// Robot 3 heads for -x (a quarter turn) and drives at 0.5 m/s to +y: to its right.
  static std::string team_log(std::int64_t from_ms, int records = 100) {
    std::ostringstream out;
    imports::TeamLogWriting log(out);
    std::string robot = imports::told_robot(3, 1.0, 2.0, "1");
    robot.replace(robot.find("0.25"), 4, "1.5707963267948966");
    for (int i = 0; i < records; ++i)
      log.record(from_ms + i * 100, i * 100, imports::worldstate(robot, imports::told_ball(0.5)));
    log.close();
    return out.str();
  }

  template <class... T>
  std::vector<std::tuple<T...>> rows(const std::string& sql) const {
    std::vector<std::tuple<T...>> all;
    Reader(path()).query(sql, [&](T... cells) { all.emplace_back(cells...); });
    return all;
  }
};

TEST_F(ImportRefbox, AnArchiveThatWouldUnpackToMoreThanAMatchIsRefused) {
  const std::string bomb = imports::zip_of({{"x.A.msl", std::string(300'000'000, ' ')}});
  EXPECT_THAT([&] { run("import refbox " + write("bomb.zip", bomb)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("x.A.msl is larger than 256 MB")));
  std::string lies = imports::zip_of({{"x.msl", kShortGame}});
  const std::uint32_t size = static_cast<std::uint32_t>(std::string(kShortGame).size());
  for (std::size_t at = 0; (at = lies.find(static_cast<char>(size & 0xFF) +
                                               std::string(1, static_cast<char>(size >> 8)) + std::string(2, '\0'),
                                           at)) != std::string::npos;
       ++at)
    lies[at] = 4;
  EXPECT_THAT(run("import refbox " + write("lies.zip", lies)).out,
              HasSubstr("it holds more than the archive's directory says"));
}

TEST_F(ImportRefbox, RestartsGoalsAndStagesAreThoseOfTheSideThatIsOurs) {
  const std::string box = std::string(TRIVELA_SOURCE_DIR) + "/tests/data/refbox/20240719_101500.msl";
  const std::string sql =
      "SELECT seq, stage, restart, ours, goals_own, goals_other FROM referee WHERE seq IN (2, 6, 12, 24)";
  using Word = std::tuple<std::int64_t, std::string, std::string, std::int64_t, std::int64_t, std::int64_t>;
  EXPECT_EQ(run("import refbox " + box + " --out " + path().string()).exit_code, kDone);
  EXPECT_THAT((rows<std::int64_t, std::string, std::string, std::int64_t, std::int64_t, std::int64_t>(sql)),
              ElementsAre(Word{2, "unknown", "kickoff", 1, 0, 0}, Word{6, "first_half", "throwin", 0, 0, 0},
                          Word{12, "first_half", "kickoff", 0, 1, 0}, Word{24, "game_over", "none", 0, 1, 0}));
  std::filesystem::remove(path());
  EXPECT_EQ(run("import refbox " + box + " --team right --out " + path().string()).exit_code, kDone);
  EXPECT_THAT((rows<std::int64_t, std::string, std::string, std::int64_t, std::int64_t, std::int64_t>(sql)),
              ElementsAre(Word{2, "unknown", "kickoff", 0, 0, 0}, Word{6, "first_half", "throwin", 1, 0, 0},
                          Word{12, "first_half", "kickoff", 1, 0, 1}, Word{24, "game_over", "none", 0, 0, 1}));
}

TEST_F(ImportRefbox, ARealMatchIsPrintedAsItWasMeasured) {
  const VerbRun result = run("import refbox " + kMatchOf2018);
  EXPECT_EQ(result.exit_code, kDone);
  EXPECT_THAT(result.out, HasSubstr("33       15.3      13.0            8.40             3.9             39.6"));
  EXPECT_THAT(result.out, HasSubstr("Nothing is wrong with the files"));
  const auto json = nlohmann::json::parse(run("import refbox --json " + kMatchOf2018).out);
  EXPECT_EQ(json["referee"][0]["plays"].size(), 33u);
  EXPECT_NEAR(json["referee"][0]["restart_to_start_median_s"], 8.8, 0.05);
  EXPECT_THAT(json["faults"], IsEmpty());
}

TEST_F(ImportRefbox, MakesAMatchLogThatSaysWhereItIsFrom) {
  const VerbRun result = run("import refbox " + kMatchOf2018 + " --out " + path().string());
  EXPECT_EQ(result.exit_code, kDone);
  EXPECT_THAT(result.out, HasSubstr("170 commands of the referee, 0 world states"));
  EXPECT_THAT((rows<int, int>("SELECT count(*), sum(playing) FROM referee")), ElementsAre(std::tuple(170, 33)));
  const Reader reader(path());
  ASSERT_EQ(reader.sessions().size(), 1u);
  const auto session = reader.sessions().front();
  EXPECT_FALSE(session.simulated);
  EXPECT_FALSE(session.simulated_clock);
  EXPECT_EQ(session.realtime_offset_ns, 1529326805014'000'000);
  EXPECT_TRUE(session.closed_t_ns);
  const VerbRun report = run("report " + path().string());
  EXPECT_EQ(report.exit_code, kDone);
  EXPECT_THAT(report.out, HasSubstr("imported from the referee box's 20180618_085311.msl: 170 commands, no kick"));
  EXPECT_THAT(report.out, HasSubstr("there are no kicks"));
  EXPECT_THAT(report.out, Not(HasSubstr("SIMULATED")));
}

TEST_F(ImportRefbox, RobotsAndBallOfAnArchiveStandInTheLogByGameTime) {
  const std::string zip = write("x.zip", imports::zip_of({{"x.A.msl", team_log(1000000)},
                                                          {"x.B.msl", team_log(1000000, 50)},
                                                          {"x.msl", kShortGame, false},
                                                          {"readme.txt", "hello"}}));
  const VerbRun result = run("import refbox " + zip + " --out " + path().string());
  EXPECT_EQ(result.exit_code, kDone) << result.out;
  EXPECT_THAT(result.out, HasSubstr("4 commands of the referee, 100 world states of the cyan team; --team takes"));
  EXPECT_THAT((rows<int, int, std::int64_t, std::int64_t>("SELECT robot_id, count(*), min(t_ns), max(t_ns) FROM "
                                                          "world_states GROUP BY 1")),
              ElementsAre(std::tuple(3, 100, 0, 9'900'000'000)));
  // 20 records before START at 2 s, 60 until the STOP at 8 s.
  EXPECT_THAT((rows<int, int>("SELECT sum(playing), sum(possession) FROM world_states")),
              ElementsAre(std::tuple(60, 100)));
  const auto first = rows<double, double, double, double>(
      "SELECT vx_mps, vy_mps, ball_x_m, heading_rad FROM world_states WHERE seq = 1");
  ASSERT_EQ(first.size(), 1u);
  EXPECT_NEAR(std::get<0>(first[0]), 0.5, 1e-12);
  EXPECT_NEAR(std::get<1>(first[0]), 0.0, 1e-12);
  EXPECT_EQ(std::get<2>(first[0]), 0.5);
  EXPECT_THAT((rows<int>("SELECT count(*) FROM world_states WHERE ball_age_s IS NULL AND opponent_distance_m IS NULL")),
              ElementsAre(std::tuple(100)));
}

TEST_F(ImportRefbox, TheOtherTeamIsTakenWhereItIsAskedFor) {
  const std::string files = write("x.B.msl", team_log(1000000, 50)) + " " + write("x.msl", kShortGame);
  EXPECT_THAT(run("import refbox " + files + " --team magenta --out " + path().string()).out,
              HasSubstr("50 world states of the magenta team"));
}

TEST_F(ImportRefbox, VelocitiesThatAreNotToldFollowFromThePoses) {
  std::ostringstream out;
  imports::TeamLogWriting log(out);
  for (int i = 0; i < 10; ++i) {
    const std::string robot = fmt::format(R"({{"id":1,"pose":[{},0,0],"velocity":null}})", 0.2 * i);
    log.record(1000000 + (i < 5 ? i * 100 : i * 100 + 700), i < 5 ? i * 100 : i * 100 + 700,
               imports::worldstate(robot, ""));
  }
  log.close();
  const std::string files = write("x.A.msl", out.str()) + " " + write("x.msl", kShortGame);
  const VerbRun result = run("import refbox " + files + " --out " + path().string());
  EXPECT_THAT(result.out, HasSubstr("8 world states of the cyan team; 2 without a velocity left out"));
  EXPECT_THAT((rows<int>("SELECT count(*) FROM world_states WHERE abs(vx_mps - 2.0) < 1e-9 AND ball_known = 0")),
              ElementsAre(std::tuple(8)));
}

TEST_F(ImportRefbox, WhatCannotBeUsedIsALossAndNothingUsableAFailure) {
  const std::string cut = team_log(1000000).substr(0, 5000);
  EXPECT_EQ(run("import refbox " + write("x.A.msl", cut)).exit_code, kDoneWithLoss);
  EXPECT_EQ(run("import refbox " + write("y.msl", std::string(kShortGame) + "hello\n")).exit_code, kDoneWithLoss);
  EXPECT_EQ(run("import refbox " + write("z.msl", "hello\n")).exit_code, kFailed);
  EXPECT_EQ(run("import refbox " + write("e.A.msl", "")).exit_code, kFailed);
  EXPECT_THAT([&] { run("import refbox " + path("none.msl").string()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("none.msl: No such file")));
  EXPECT_THAT(
      [&] {
        run("import refbox " + write("x.zip", imports::zip_of({{"a.txt", "x"}})));
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("no .msl file in it")));
  const std::string zip = imports::zip_of({{"x.msl", kShortGame, false}});
  std::string changed = zip;
  changed[zip.find("START")] = 'Z';
  EXPECT_THAT(run("import refbox " + write("x.zip", changed)).out,
              HasSubstr("x.msl: cannot be read to its end: its bytes are not those that were packed"));
}

TEST_F(ImportRefbox, AMatchLogIsOfOneMatchAndNeverOverwritten) {
  const std::string text = write("x.msl", kShortGame), out = " --out " + path().string();
  EXPECT_THROW(run("import refbox " + write("x.A.msl", team_log(1000000)) + out), UsageError);
  EXPECT_THROW(run("import refbox " + text + " " + kMatchOf2018 + out), UsageError);
  EXPECT_THAT(
      [&] { run("import refbox " + text + " " + write("y.A.msl", team_log(90'000'000)) + out); },
      ThrowsMessage<std::runtime_error>(HasSubstr("y.A.msl and x.msl are not of the same match: they are 24.7 h")));
  EXPECT_FALSE(std::filesystem::exists(path()));
  run("import refbox " + text + out);
  EXPECT_THROW(run("import refbox " + text + out), UsageError);
  EXPECT_EQ(Reader(path()).sessions().size(), 1u);
}

}  // namespace
}  // namespace trivela::cli
