#include "evaluator/stats/clustered.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/evaluator/random_numbers.hpp"

namespace trivela::evaluator::stats {
namespace {

std::vector<Influence> crossed(std::uint32_t matches, std::uint32_t calibrations, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Influence> cells;
  for (std::uint32_t k = 0; k < calibrations; ++k) {
    for (std::uint32_t m = 0; m < matches; ++m) cells.push_back({m, k, random.normal()});
  }
  return cells;
}

// Influences of the mean of what the cells hold.
std::vector<Influence> of_their_mean(std::vector<Influence> cells) {
  double mean = 0.0;
  for (const Influence& cell : cells) mean += cell.u / static_cast<double>(cells.size());
  for (Influence& cell : cells) cell.u = (cell.u - mean) / static_cast<double>(cells.size());
  return cells;
}

TEST(ClusterVariance, OfOneCalibrationIsThatOfTheMatches) {
  const auto cells = of_their_mean(crossed(7, 1, 1));
  double squares = 0.0;
  for (const Influence& cell : cells) squares += cell.u * cell.u;
  const auto result = *cluster_variance(cells);
  EXPECT_NEAR(result.variance, 7.0 / 6.0 * squares, 1e-15);
  EXPECT_EQ(result.df, 6.0);
  EXPECT_FALSE(result.by_calibration);
  EXPECT_FALSE(cluster_variance(std::vector<Influence>{{3, 0, 1.0}, {3, 1, -1.0}})) << "one match";
}

TEST(ClusterVariance, OfFewCalibrationsIsOfThoseAlone) {
  const auto result = *cluster_variance(of_their_mean(crossed(9, 4, 2)));
  EXPECT_FALSE(result.by_calibration);
  EXPECT_EQ(result.calibrations, 4U);
  EXPECT_EQ(result.df, 8.0);
  EXPECT_TRUE(cluster_variance(of_their_mean(crossed(9, 5, 2)))->by_calibration);
}

TEST(ClusterVariance, OfCrossedCellsIsThatOfTheMeanSquares) {
  // The analysis of variance of a crossed design has (MS_match + MS_calibration - MS_both) / (M K) for its mean.
  constexpr std::uint32_t kM = 12, kK = 6;
  auto cells = crossed(kM, kK, 3);
  for (Influence& cell : cells) cell.u += 0.9 * std::sin(cell.match) + 0.7 * std::cos(3.0 * cell.calibration);
  std::vector<double> rows(kM), columns(kK);
  double mean = 0.0, ms_rows = 0.0, ms_columns = 0.0, ms_both = 0.0;
  for (const Influence& cell : cells) {
    rows[cell.match] += cell.u / kK;
    columns[cell.calibration] += cell.u / kM;
    mean += cell.u / (kM * kK);
  }
  for (const double row : rows) ms_rows += kK * (row - mean) * (row - mean) / (kM - 1.0);
  for (const double column : columns) ms_columns += kM * (column - mean) * (column - mean) / (kK - 1.0);
  for (const Influence& cell : cells) {
    const double rest = cell.u - rows[cell.match] - columns[cell.calibration] + mean;
    ms_both += rest * rest / ((kM - 1.0) * (kK - 1.0));
  }
  const double sum = ms_rows + ms_columns - ms_both;
  const auto result = *cluster_variance(of_their_mean(cells));
  EXPECT_NEAR(result.variance, sum / (kM * kK), 1e-14);
  EXPECT_NEAR(result.df,
              sum * sum /
                  (ms_rows * ms_rows / (kM - 1.0) + ms_columns * ms_columns / (kK - 1.0) +
                   ms_both * ms_both / ((kM - 1.0) * (kK - 1.0))),
              1e-9);
}

TEST(ClusterVariance, OfMatchesThatHaveACalibrationEachIsThatOfTheCalibrations) {
  std::vector<Influence> cells;
  RandomNumbers random(4);
  for (std::uint32_t k = 0; k < 8; ++k) {
    const double calibration = random.normal();
    for (std::uint32_t m = 0; m < 50; ++m) cells.push_back({50 * k + m, k, calibration + random.normal()});
  }
  cells = of_their_mean(cells);
  std::vector<double> sums(8);
  double squares = 0.0;
  for (const Influence& cell : cells) sums[cell.calibration] += cell.u;
  for (const double sum : sums) squares += sum * sum;
  const auto result = *cluster_variance(cells);
  EXPECT_NEAR(result.variance, 8.0 / 7.0 * 400.0 / 399.0 * squares, 1e-14);
  EXPECT_NEAR(result.df, 7.0, 0.1);
}

TEST(ClusterVariance, IsNeverBelowThatOfOneKindOfCluster) {
  // Matches that go with calibration in a checkerboard: what is common cancels in both sums, not in the cells.
  std::vector<Influence> cells;
  for (std::uint32_t k = 0; k < 6; ++k) {
    for (std::uint32_t m = 0; m < 6; ++m)
      cells.push_back({m, k, ((m + k) % 2 ? 0.1 : -0.1) + (m == 0 ? 0.01 : -0.002)});
  }
  const auto result = *cluster_variance(cells);
  EXPECT_GT(result.variance, 0.0);
  EXPECT_GT(result.df, 0.0);
  EXPECT_TRUE(std::isfinite(result.reach()));
}

TEST(Jackknife, OfAMeanIsWhatEachValueAddsToIt) {
  const std::vector<double> values{1.0, 4.0, 10.0};
  const auto without = [&](std::size_t i) { return (15.0 - values[i]) / 2.0; };
  const std::vector<double> u = jackknife(values.size(), without);
  ASSERT_EQ(u.size(), values.size());
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], (values[i] - 5.0) / 3.0, 1e-12);
}

}  // namespace
}  // namespace trivela::evaluator::stats
