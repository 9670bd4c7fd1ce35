#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cli/kick/row_verbs.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

struct Ran {
  ExitCode code = kDone;
  std::string out;
  std::string err;
};

Ran run(const RowVerb& verb, const std::string& text, RowFormat format = RowFormat::kCsv) {
  std::istringstream in(text);
  std::ostringstream out;
  std::ostringstream err;
  const ExitCode code = run_rows(verb, in, "rows.csv", format, out, err);
  return {code, out.str(), err.str()};
}

Ran run_vectors(const RowVerb& verb, const std::string& name) {
  std::ifstream file(std::string(TRIVELA_SOURCE_DIR) + "/tests/vectors/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return run(verb, text.str());
}

std::vector<tests::VectorRow> parse(const std::string& text) {
  std::istringstream in(text);
  config::CsvReader reader(in);
  const auto header = reader.next();
  std::vector<tests::VectorRow> rows;
  while (auto record = reader.next()) rows.emplace_back(header->cells, *record);
  return rows;
}

/// Numbers are equal to 1e-6, or both cells are empty.
void expect_same(const tests::VectorRow& row, const char* actual, const char* expected) {
  ASSERT_EQ(row.has(actual), row.has(expected)) << actual;
  if (row.has(actual)) {
    EXPECT_NEAR(row.number(actual), row.number(expected), 1e-6) << actual;
  }
}

TEST(Solve, AgreesWithTheVectorsOfAMovingKick) {
  const Ran ran = run_vectors(solve_verb({}, {}), "moving_kick.csv");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  const auto rows = parse(ran.out);
  ASSERT_EQ(rows.size(), tests::rows("moving_kick.csv").size());
  for (const auto& row : rows) {
    SCOPED_TRACE(row.where());
    expect_same(row, "v0_mps", "v0_stopped");
    expect_same(row, "vk_exact_mps", "vk_exact");
    expect_same(row, "vk_paper_mps", "vk_paper");
    EXPECT_EQ(row.text("feasible"), "1");
  }
}

TEST(Solve, AgreesWithTheVectorsOfDrag) {
  const Ran ran = run_vectors(solve_verb({}, {}), "drag_v0_for_crossing.csv");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  for (const auto& row : parse(ran.out)) {
    SCOPED_TRACE(row.where());
    EXPECT_NEAR(row.number("v0_drag_mps"), row.number("v0_drag"), 1e-5);
  }
}

TEST(Solve, LeavesTheResultsOfAnInfeasibleRowEmptyAndSaysSo) {
  EXPECT_EQ(run(solve_verb({}, {}), "theta_deg,d_m,h_rel_m\n36.78,0.5,0.59\n").out,
            "theta_deg,d_m,h_rel_m,v0_mps,vk_exact_mps,vk_paper_mps,feasible,descending\n36.78,0.5,0.59,,,,0,\n");
}

TEST(Solve, GivesTheFractionalPowerOfARobot) {
  const Ran ran =
      run(solve_verb({}, kicking::RobotModel{}.table), "theta_deg,d_m,h_rel_m\n36.78,5.73,0.59\n36.78,12,0.59\n");
  const auto rows = parse(ran.out);
  const double v0 = rows.at(0).number("v0_mps");
  EXPECT_NEAR(rows[0].number("power"), 20.0 + 5.0 * (v0 - 7.33) / (8.39 - 7.33), 1e-6);
  EXPECT_EQ(rows[0].text("power_range"), "in");
  EXPECT_EQ(rows.at(1).text("power"), "50");
  EXPECT_EQ(rows[1].text("power_range"), "above");
}

TEST(Solve, TakesOtherConstants) {
  FlightConstants moon;
  moon.gravity_mps2 = 9.81 / 4.0;
  const char* row = "theta_deg,d_m,h_rel_m,Cd\n45,5,0.5,0.3\n";
  const auto here = parse(run(solve_verb({}, {}), row).out).at(0);
  const auto there = parse(run(solve_verb(moon, {}), row).out).at(0);
  EXPECT_NEAR(there.number("v0_mps"), here.number("v0_mps") / 2.0, 1e-8);
  FlightConstants heavy;
  heavy.ball.mass_kg = 1e6;
  EXPECT_NEAR(parse(run(solve_verb(heavy, {}), row).out).at(0).number("v0_drag_mps"), here.number("v0_mps"), 1e-5);
}

TEST(Align, AgreesWithItsVectors) {
  const Ran ran = run_vectors(align_verb(), "alignment.csv");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  const auto rows = parse(ran.out);
  const auto expected = tests::rows("alignment.csv");
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(rows[i].where());
    EXPECT_EQ(rows[i].text("name"), expected[i].text("name"));
    expect_same(rows[i], "distance_m", "distance");
    expect_same(rows[i], "left_m", "left_len");
    expect_same(rows[i], "right_m", "right_len");
  }
  EXPECT_THAT(ran.out, HasSubstr("\n\"CCW, 10.05 deg -> outside (rule max)\",0,3,-10.050000000,"));
}

TEST(Align, AppendsItsVerdict) {
  const Ran ran = run(align_verb(),
                      "px,py,orientation_deg,alpha_deg,tx,ty,beta_deg,omega_rad_s,rule,note\n"
                      "0,3,-8,0,0,9,10,1,add,turns in\n0,3,90,0,0,9,0,0,,parallel\n");
  EXPECT_THAT(ran.out, HasSubstr("add,turns in,6,0.8432450082,0.1,1.157961884,1\n"));
  EXPECT_THAT(ran.out, HasSubstr(",parallel,6,,0.1,0.1,0\n"));
}

TEST(Predict, AgreesWithItsVectors) {
  const Ran ran = run_vectors(predict_verb({}), "release_prediction.csv");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  const auto rows = parse(ran.out);
  ASSERT_EQ(rows.size(), tests::rows("release_prediction.csv").size());
  for (const auto& row : rows) {
    SCOPED_TRACE(row.where());
    expect_same(row, "x_cross_m", "x_cross");
    expect_same(row, "z_cross_m", "z_cross");
    expect_same(row, "t_flight_s", "t_flight");
  }
}

TEST(Rows, NameLineColumnAndValueOfABadRowAndStillGiveTheOthers) {
  const Ran ran = run(solve_verb({}, {}),
                      "# comment\ntheta_deg,d_m,h_rel_m,Cd\n45,5,0.5,\n45,far,0.5,\n45,5\n45,5,0.5,0.2,9\n45,nan,0.5,\n"
                      "45,5,inf,\n95,5,0.5,\n45,-5,0.5,\n45,,0.5,\n45,5,0.5,-0.1\n45,1e999,0.5,\n45,6,0.5,\n");
  EXPECT_EQ(ran.code, kFailed);
  EXPECT_EQ(parse(ran.out).size(), 2u);
  EXPECT_EQ(ran.err,
            "rows.csv:4: column d_m: 'far' is not a number\n"
            "rows.csv:5: column h_rel_m: is missing: 2 cells under 4 columns\n"
            "rows.csv:6: column 5: '9' is too much: 5 cells under 4 columns\n"
            "rows.csv:7: column d_m: 'nan' is not finite\n"
            "rows.csv:8: column h_rel_m: 'inf' is not finite\n"
            "rows.csv:9: column theta_deg: '95' is not between 0 and 90 degrees\n"
            "rows.csv:10: column d_m: '-5' is not above 0\n"
            "rows.csv:11: column d_m: is empty\n"
            "rows.csv:12: column Cd: '-0.1' is not from 0 to 10\n"
            "rows.csv:13: column d_m: '1e999' is not a number\n");
}

TEST(Rows, NameWhatIsWrongWithTheHeader) {
  EXPECT_THROW(run(align_verb(), "px,py\n1,2\n"), std::runtime_error);
  EXPECT_THROW(run(align_verb(), ""), std::runtime_error);
  EXPECT_THROW(run(solve_verb({}, {}), "theta_deg,d_m,d_m,h_rel_m\n"), std::runtime_error);
}

TEST(Rows, NameAnUnknownRule) {
  EXPECT_EQ(
      run(align_verb(), "px,py,orientation_deg,alpha_deg,tx,ty,beta_deg,omega_rad_s,rule\n0,3,0,0,0,9,0,0,mid\n").err,
      "rows.csv:2: column rule: 'mid' is neither max nor add\n");
}

TEST(Rows, SurviveWindowsLineEndsSpacesAndQuotes) {
  const Ran ran = run(solve_verb({}, {}), "who,theta_deg, d_m,h_rel_m\r\n\"a, \"\"b\"\"\",45, 5 ,+0.5\r\n");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("\n\"a, \"\"b\"\"\",45, 5 ,+0.5,"));
}

TEST(Rows, ComeOutAsJson) {
  const Ran ran = run(solve_verb({}, {}), "name,theta_deg,d_m,h_rel_m\nx,45,5,0\ny,45,0.1,0.5\n", RowFormat::kJson);
  EXPECT_THAT(ran.out,
              AllOf(StartsWith("["), HasSubstr("\"name\": \"x\""), HasSubstr("\"feasible\": true"),
                    HasSubstr("\"d_m\": 5.0"), HasSubstr("\"v0_mps\": null"), HasSubstr("\"feasible\": false")));
}

class CommandLine : public testing::Test {
 protected:
  /// Standard output of `trivela ...`.
  std::string run(const std::string& line) {
    const VerbRun run = run_verbs({add_solve, add_align, add_predict}, line);
    exit_code_ = run.exit_code;
    return run.out;
  }
  int exit_code_ = kDone;
};

TEST_F(CommandLine, PrintsHeaderAndRowForSingleValues) {
  const auto row = parse(run("solve --theta-deg 36.78 --d-m 5.73 --h-rel-m 0.59 --v-front-mps 1")).at(0);
  EXPECT_NEAR(row.number("vk_exact_mps"), 7.751538, 1e-6);
  EXPECT_NEAR(row.number("vk_paper_mps"), 7.443415, 1e-6);
  EXPECT_EQ(
      parse(run("align --px 0 --py-m 3 --orientation-deg -8 --alpha-deg 0 --tx 0 --ty 9 --beta-deg 10 --omega-rad-s 1"))
          .at(0)
          .text("aligned"),
      "1");
  EXPECT_NEAR(parse(run("predict --px 0 --py 3 --orientation-rad 0 --vx 1 --vy 0 --omega 0 --tau-s 0.08 --r-m 0.27 "
                        "--vk 8.2443 --theta-deg 36.78 --k 1 --goal-y 9"))
                  .at(0)
                  .number("x_cross_m"),
              0.947762, 1e-6);
}

TEST_F(CommandLine, ReadsAFileAndARobot) {
  const std::string source = TRIVELA_SOURCE_DIR;
  const auto rows = parse(run("solve --csv " + source + "/tests/vectors/v0_for_crossing.csv --robot " + source +
                              "/config/robots/cambada_1.toml"));
  ASSERT_EQ(rows.size(), tests::rows("v0_for_crossing.csv").size());
  for (const auto& row : rows) {
    SCOPED_TRACE(row.where());
    expect_same(row, "v0_mps", "v0_exact_mps");
    EXPECT_GE(row.number("power"), 15.0);
  }
}

TEST_F(CommandLine, RefusesArgumentsThatMakeNoSense) {
  EXPECT_THROW(run("solve --theta-deg 36.78 --d-m 5.73"), UsageError);
  EXPECT_THROW(run("solve --theta-deg 36.78 --d-m nan --h-rel-m 0.5"), UsageError);
  EXPECT_THROW(run("solve --theta-deg 36.78 --csv x.csv"), UsageError);
  EXPECT_THROW(run("solve --csv no_such_file.csv"), std::runtime_error);
  EXPECT_THROW(run("solve --gravity-mps2 -1 --theta-deg 45 --d-m 5 --h-rel-m 0"), CLI::ParseError);
}

}  // namespace
}  // namespace trivela::cli
