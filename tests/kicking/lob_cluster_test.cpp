#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "kicking/geometry/angle.hpp"
#include "kicking/lob/background.hpp"
#include "kicking/lob/candidates.hpp"

namespace trivela::kicking::lob {
namespace {

const double kStep_rad = radians(0.25);

std::vector<BeamReturn> returns_at(const std::vector<std::pair<int, double>>& beams) {
  std::vector<BeamReturn> returns;
  for (const auto& [beam, range_m] : beams)
    returns.push_back({beam, 0, range_m, std::cos(beam * kStep_rad), std::sin(beam * kStep_rad)});
  return returns;
}

std::vector<std::pair<std::size_t, std::size_t>> clusters_of(const std::vector<std::pair<int, double>>& beams) {
  std::vector<Cluster> found;
  find_clusters(returns_at(beams), kStep_rad, 0.10, found);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  for (const Cluster& cluster : found) ends.emplace_back(cluster.first, cluster.last);
  return ends;
}

using Ends = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(Clusters, PartAtAGapInRangeAndLeaveOutSingleReturns) {
  EXPECT_EQ(clusters_of({{10, 4.0}, {11, 4.0}, {12, 4.05}, {13, 6.0}, {14, 2.0}, {15, 2.0}}), (Ends{{0, 2}, {4, 5}}));
  EXPECT_EQ(clusters_of({{10, 4.0}, {11, 4.09}}), (Ends{{0, 1}}));
  EXPECT_EQ(clusters_of({{10, 4.0}, {11, 4.13}}), Ends{});
  EXPECT_EQ(clusters_of({{10, 4.0}}), Ends{});
  EXPECT_EQ(clusters_of({}), Ends{});
}

TEST(Clusters, BridgeTwoMissingBeamsAndNoMore) {
  EXPECT_EQ(clusters_of({{10, 1.0}, {13, 1.0}}), (Ends{{0, 1}}));
  EXPECT_EQ(clusters_of({{10, 1.0}, {14, 1.0}}), Ends{});
}

TEST(Clusters, GapGrowsWithTheStepOfTheBeams) {
  const double far = 20.0, step_m = far * kStep_rad;
  EXPECT_EQ(clusters_of({{10, far}, {11, far + 0.099}}), (Ends{{0, 1}}));
  EXPECT_EQ(clusters_of({{10, far}, {11, far + 0.11 + step_m}}), Ends{});
}

ScanGeometry few_beams(std::size_t beams) {
  ScanGeometry geometry;
  geometry.beams = beams;
  return geometry;
}

/// A background learned from the ranges of one beam.
Background learned(const std::vector<std::uint32_t>& ranges_mm) {
  AnalyzerConfig config;
  config.background_scans = ranges_mm.size();
  Background background(few_beams(1), config);
  for (const std::uint32_t range_mm : ranges_mm) background.learn({0, {range_mm}});
  return background;
}

TEST(Background, KnowsNothingUntilItHasSeenItsScans) {
  AnalyzerConfig config;
  config.background_scans = 3;
  Background background(few_beams(2), config);
  EXPECT_FALSE(background.learn({0, {1000, 1000}}));
  EXPECT_FALSE(background.learn({1, {1000, 1000}}));
  EXPECT_FALSE(background.known());
  EXPECT_FALSE(background.is_foreground(0, 500));
  EXPECT_TRUE(background.learn({2, {1000, 1000}}));
  EXPECT_TRUE(background.is_foreground(0, 500));
  background.forget();
  EXPECT_FALSE(background.known());
  EXPECT_FALSE(background.is_foreground(0, 500));
}

TEST(Background, ReturnIsForegroundWhenNearerByTheMargin) {
  const Background background = learned({3000, 3010, 2990, 3000, 1});  // median 3.00 m, MAD 5 mm or less
  EXPECT_EQ(background.range_m()[0], 3.0);
  EXPECT_TRUE(background.is_foreground(0, 2849));
  EXPECT_FALSE(background.is_foreground(0, 2850));
  EXPECT_FALSE(background.is_foreground(0, 3000));
  EXPECT_FALSE(background.is_foreground(0, 3300));
}

TEST(Background, RestlessBeamNeedsFiveDeviations) {
  const Background background = learned({2900, 2950, 3000, 3050, 3100});  // MAD 50 mm
  EXPECT_TRUE(background.is_foreground(0, 2749));
  EXPECT_FALSE(background.is_foreground(0, 2750));
}

TEST(Background, NoReturnIsAClassOfItsOwn) {
  const Background empty = learned({1, 1, 0, 19, 65533});
  EXPECT_LT(empty.range_m()[0], 0.0);
  EXPECT_TRUE(empty.is_foreground(0, 29'000)) << "infinity before, a return now";
  EXPECT_FALSE(empty.is_foreground(0, 1)) << "still none";
  EXPECT_FALSE(empty.is_foreground(0, 65533)) << "beyond the scanner's range";
  EXPECT_FALSE(empty.is_foreground(0, 50)) << "nearer than the scanner's range";
}

TEST(Background, ReturnsNowAndThenAreBackgroundToo) {
  const Background flickering = learned({1, 1, 1, 1, 1, 5000, 5010, 1});
  EXPECT_LT(flickering.range_m()[0], 0.0);
  EXPECT_FALSE(flickering.is_foreground(0, 5005));
  EXPECT_TRUE(flickering.is_foreground(0, 4000));
}

TEST(Background, StrayReturnIsNone) {
  std::vector<std::uint32_t> ranges(40, 1);
  ranges[7] = 2000;
  EXPECT_TRUE(learned(ranges).is_foreground(0, 5000));
}

TEST(Background, RefusesToLearnFromNothing) {
  AnalyzerConfig config;
  config.background_scans = 0;
  EXPECT_THROW(Background(few_beams(1), config), std::invalid_argument);
}

}  // namespace
}  // namespace trivela::kicking::lob
