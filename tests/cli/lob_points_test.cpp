#include "cli/lob_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

const std::string kVectors = std::string(TRIVELA_SOURCE_DIR) + "/tests/vectors/";
constexpr kicking::lob::ScannerPlace kPlace{4.0, 0.05};

struct PointsRan {
  int code = kDone;
  std::string out, err;
};

PointsRan run(const PointsFlags& flags) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  PointsRan ran;
  ran.code = run_lob_points(flags, kPlace);
  ran.out = testing::internal::GetCapturedStdout();
  ran.err = testing::internal::GetCapturedStderr();
  return ran;
}

PointsFlags parsed(const std::string& line) {
  CLI::App app;
  PointsFlags flags;
  add_points_flags(app, flags);
  app.parse(line);
  return flags;
}

PointsRan run(const std::string& line) { return run(parsed(line)); }

/// The vector without the scans from `first_left_out` on.
std::string shortened(int first_left_out) {
  const std::string path = testing::TempDir() + "lob_points_" + std::to_string(first_left_out) + ".csv";
  std::ifstream in(kVectors + "lob_scan_utm_under.csv");
  std::ofstream out(path);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#') || line.starts_with("scan") || std::stoi(line) < first_left_out) out << line << '\n';
  }
  return path;
}

/// The vector with the instants of the scans from `first` on moved by so many seconds.
std::string moved(int first, double by_s) {
  const std::string path = testing::TempDir() + "lob_points_moved.csv";
  std::ifstream in(kVectors + "lob_scan_utm_under.csv");
  std::ofstream out(path);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#') || line.starts_with("scan") || std::stoi(line) < first) {
      out << line << '\n';
      continue;
    }
    std::istringstream cells(line);
    std::string scan, start_s, beam_s, rest;
    std::getline(std::getline(std::getline(std::getline(cells, scan, ','), start_s, ','), beam_s, ','), rest);
    out << fmt::format("{},{:.9f},{:.9f},{}\n", scan, std::stod(start_s) + by_s, std::stod(beam_s) + by_s, rest);
  }
  return path;
}

TEST(LobPoints, StampsThatGoBackOrJumpAreRefusedAndNamed) {
  EXPECT_EQ(run("--points " + moved(20, 0.0)).code, kDone);
  for (const auto& [by_s, sentence] : std::vector<std::pair<double, std::string>>{
           {-16777.216, "time goes back by 16777.2 s from scan 19 to 20"},
           {-0.05, "time goes back by 0.025 s from scan 19 to 20"},
           {0.05, "0.075 s pass from scan 19 to 20, where 0.025 s pass from scan to scan"},
           {10.0, "10.03 s pass from scan 19 to 20"}}) {
    const PointsRan ran = run("--points " + moved(20, by_s));
    EXPECT_EQ(ran.code, kFailed) << by_s;
    EXPECT_THAT(ran.err, HasSubstr(sentence));
    EXPECT_EQ(ran.out, "");
  }
}

TEST(LobPoints, JsonHoldsBothFitsWithTheirStandardErrors) {
  const PointsRan ran = run("--points " + kVectors + "lob_scan_utm_under.csv --json");
  EXPECT_EQ(ran.code, kDone) << ran.err;
  const Json lob = Json::parse(ran.out);
  EXPECT_NEAR(lob["effective"]["exit_angle_deg"].get<double>(), 37.61, 0.1);
  EXPECT_NEAR(lob["effective"]["exit_speed_mps"].get<double>(), 8.0927, 0.02);
  EXPECT_NEAR(lob["effective"]["height_m"].get<double>(), 1.243, 0.005);
  EXPECT_NEAR(lob["effective"]["distance_m"].get<double>(), 6.455, 0.02);
  EXPECT_NEAR(lob["true"]["exit_angle_deg"].get<double>(), 36.78, 0.1);
  EXPECT_NEAR(lob["true"]["exit_speed_mps"].get<double>(), 8.39, 0.02);
  EXPECT_NEAR(lob["true"]["Cd"].get<double>(), 0.25, 0.02);
  for (const char* name : {"exit_angle_deg_se", "exit_speed_mps_se", "height_m_se", "distance_m_se"})
    EXPECT_GT(lob["effective"][name].get<double>(), 0.0) << name;
  for (const char* name : {"exit_angle_deg_se", "exit_speed_mps_se", "Cd_se"})
    EXPECT_GT(lob["true"][name].get<double>(), 0.0) << name;
  EXPECT_LT(lob["residual_rms_m"].get<double>(), 0.005);
  EXPECT_EQ(lob["points"], 41);
  EXPECT_EQ(lob["accepted"], true);
  EXPECT_EQ(lob["refusal"], "none");
  EXPECT_EQ(lob["why"], "");
}

TEST(LobPoints, TextIsForHumans) {
  const PointsRan ran = run("--points " + kVectors + "lob_scan_utm_under.csv");
  EXPECT_THAT(ran.out, StartsWith("41 centres of the ball: a lob\n"));
  EXPECT_THAT(ran.out, HasSubstr("true, from the times, with drag:\n  exit angle    36."));
}

TEST(LobPoints, TakesDragAndCentreFromTheFlags) {
  const std::string file = "--points " + kVectors + "lob_scan_utm_under.csv --json ";
  const Json given = Json::parse(run(file + "--cd 0.3").out);
  EXPECT_EQ(given["true"]["Cd"], 0.3);
  EXPECT_EQ(given["true"]["Cd_se"], 0.0);
  const Json paper = Json::parse(run(file + "--centre middle").out);
  EXPECT_GT(paper["effective"]["exit_angle_deg"].get<double>(), 38.2);
  EXPECT_THROW(parsed("--points x --centre mean"), CLI::ParseError);
  EXPECT_THROW(parsed("--points x --cd -1"), CLI::ParseError);
}

TEST(LobPoints, RefusedFlightFailsAndStillComesOut) {
  const PointsRan few = run("--json --points " + shortened(6));
  EXPECT_EQ(few.code, kFailed);
  EXPECT_EQ(Json::parse(few.out)["refusal"], "too_few_points");
  EXPECT_EQ(Json::parse(few.out)["accepted"], false);
  const PointsRan rising = run("--points " + shortened(16));
  EXPECT_EQ(rising.code, kFailed);
  EXPECT_THAT(rising.out, HasSubstr("refused (one_side_of_apex): the ball was seen from x = "));
}

TEST(LobPoints, WithoutAnyReturnThereIsNoFit) {
  const std::string path = testing::TempDir() + "lob_points_empty.csv";
  std::ofstream(path) << "scan,t_scan_start_s,t_beam_s,angle_deg,range_m\n";
  const PointsRan ran = run("--json --points " + path);
  EXPECT_EQ(ran.code, kFailed);
  const Json lob = Json::parse(ran.out);
  EXPECT_TRUE(lob["effective"].is_null());
  EXPECT_TRUE(lob["true"].is_null());
  EXPECT_TRUE(lob["residual_rms_m"].is_null());
  EXPECT_EQ(lob["why"], "no flight of a ball among 0 returns");
}

TEST(LobPoints, NamesLineColumnAndValueOfEachBadRow) {
  std::istringstream in(
      "# comment\nscan,t_scan_start_s,t_beam_s,angle_deg,range_m\n0,0.1,0.11,90,2\n0.5,0.1,0.11,91,2\n0,0.1,0.11,up,2\n"
      "0,0.1,0.11,90,2\n0,0.2,0.21,92,2\n0,0.1,0.09,93,2\n0,0.1,0.11,94,-1\n0,0.1,0.11,400,2\n0,0.1,0.11,95\n"
      "1,0.2,0.21,,2\n-1,0.1,0.11,90,2\n");
  std::ostringstream err;
  EXPECT_FALSE(read_returns(in, "p.csv", err));
  EXPECT_EQ(err.str(),
            "p.csv:4: column scan: '0.5' is not a whole number\n"
            "p.csv:5: column angle_deg: 'up' is not a number\n"
            "p.csv:6: column angle_deg: '90' stands twice in scan 0\n"
            "p.csv:7: column t_scan_start_s: '0.2' differs from an earlier row of scan 0: 0.1 s\n"
            "p.csv:8: column t_beam_s: '0.09' is before the start of the scan\n"
            "p.csv:9: column range_m: '-1' is not above 0\n"
            "p.csv:10: column angle_deg: '400' is not from -360 to 360\n"
            "p.csv:11: column range_m: is missing: 4 cells under 5 columns\n"
            "p.csv:12: column angle_deg: is empty\n"
            "p.csv:13: column scan: '-1' is not from 0 to 1000000000000000\n");
}

TEST(LobPoints, SaysWhatIsWrongWithTheFile) {
  EXPECT_THROW(run_lob_points(parsed("--points no_such_file.csv"), kPlace), std::runtime_error);
  EXPECT_THROW(run_lob_points(parsed("--points " + testing::TempDir()), kPlace), std::runtime_error);
  std::istringstream no_range("scan,t_scan_start_s,t_beam_s,angle_deg\n");
  std::ostringstream err;
  EXPECT_THROW(read_returns(no_range, "p.csv", err), std::runtime_error);
}

}  // namespace
}  // namespace trivela::cli
