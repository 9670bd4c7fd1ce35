// The scenario like_2016 holds what docs/data/possessions_2016.csv says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "config/scenario/scenario.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
using Column = std::vector<double>;

std::map<std::string, Column> read_columns() {
  std::ifstream file{fs::path{TRIVELA_SOURCE_DIR} / "docs/data/possessions_2016.csv"};
  std::vector<std::string> names;
  std::map<std::string, Column> columns;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const bool head = names.empty();
    std::istringstream cells{line};
    std::string cell;
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (head) {
        names.push_back(cell);
      } else {
        columns[names.at(i)].push_back(std::stod(cell));
      }
    }
  }
  return columns;
}

double mean(const Column& x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

/// Linear between the values in their order.
double quantile(Column x, double p) {
  std::ranges::sort(x);
  const double place = p * static_cast<double>(x.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  return std::lerp(x[below], x[std::min(below + 1, x.size() - 1)], place - std::floor(place));
}

Column each(const Column& x, double (*f)(double)) {
  Column out;
  std::ranges::transform(x, std::back_inserter(out), f);
  return out;
}

class Like2016 : public testing::Test {
 protected:
  std::map<std::string, Column> log = read_columns();
  sim::Scenario scenario = load_scenario(fs::path{TRIVELA_SOURCE_DIR} / "config/scenarios/like_2016.toml");

  Column closing_mps() const {
    Column out;
    for (std::size_t i = 0; i < log.at("duration_s").size(); ++i)
      out.push_back((log.at("opp_dist_start")[i] - log.at("opp_dist_min")[i]) / log.at("duration_s")[i]);
    return out;
  }
};

TEST_F(Like2016, HasThePossessionsOfTheLog) {
  ASSERT_EQ(log["duration_s"].size(), 19u);
  const sim::Possession& p = scenario.possession;
  const double mean_square = mean(each(log["aim_err_start_deg"], [](double x) { return x * x; }));
  EXPECT_NEAR(kicking::degrees(p.aim_error_sd_rad), std::sqrt(mean_square), 0.5);
  EXPECT_NEAR(p.speed_min_mps, quantile(log["speed_start"], 0.05), 0.005);
  EXPECT_NEAR(p.speed_max_mps, quantile(log["speed_start"], 0.95), 0.0051);
  EXPECT_NEAR(quantile(log["speed_start"], 0.5), 0.26, 1e-9) << "as the file and docs/simulation.md say";
  EXPECT_NEAR(p.time_limit_s, quantile(log["duration_s"], 1.0), 0.05);
}

TEST_F(Like2016, HasTheOpponentsOfTheLog) {
  const sim::Opponent& o = scenario.opponent;
  EXPECT_NEAR(o.distance_median_m, quantile(log["opp_dist_start"], 0.5), 0.005);
  const Column logarithms = each(log["opp_dist_start"], [](double x) { return std::log(x); });
  double squares = 0.0;
  for (const double x : logarithms) squares += (x - mean(logarithms)) * (x - mean(logarithms));
  EXPECT_NEAR(o.distance_sigma_ln, std::sqrt(squares / static_cast<double>(logarithms.size() - 1)), 0.005);
  EXPECT_NEAR(o.closing_min_mps, quantile(closing_mps(), 0.0), 0.005);
  EXPECT_NEAR(o.closing_max_mps, 2.0 * mean(closing_mps()), 0.005);
  EXPECT_NEAR(quantile(closing_mps(), 0.5), 0.09, 0.005) << "as the file and docs/simulation.md say";
  EXPECT_NEAR(o.dispute_distance_m, quantile(log["opp_dist_min"], 0.1), 0.01);
}

TEST_F(Like2016, TheLogsHoldersKeptTheBallWithAnOpponentNear) {
  int near = 0, nearer = 0;
  double longest_s = 0.0;
  for (std::size_t i = 0; i < log["opp_dist_min"].size(); ++i) {
    if (log["opp_dist_min"][i] >= 0.5) continue;
    ++near;
    nearer += log["opp_dist_min"][i] < scenario.opponent.dispute_distance_m;
    longest_s = std::max(longest_s, log["duration_s"][i]);
  }
  EXPECT_EQ(near, 5);
  EXPECT_EQ(nearer, 2);
  EXPECT_NEAR(longest_s, 9.2, 0.01);
}

}  // namespace
}  // namespace trivela::config
