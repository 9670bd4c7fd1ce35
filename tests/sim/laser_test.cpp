#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "kicking/geometry/time.hpp"
#include "sim/kicker/flight.hpp"
#include "sim/laser/laser.hpp"
#include "sim/laser/record.hpp"

namespace trivela::sim {
namespace {

using kicking::lob::Scan;

const kicking::Draws kDraws{5, 1};
constexpr double kRadius_m = 0.11;

LaserModel noiseless() {
  LaserModel laser;
  laser.range_sd_m = laser.dropout_ratio = laser.mixed_ratio = 0.0;
  return laser;
}

/// Scans of the first `seconds`, in steps of step_s, with the ball at place(t).
std::vector<Scan> scans_of(const LaserModel& laser, double seconds,
                           const std::function<std::optional<Eigen::Vector3d>(double)>& place, double step_s = 1e-3,
                           const kicking::Draws& draws = kDraws) {
  ScanBuilder builder(laser, kRadius_m, draws);
  std::vector<Scan> scans;
  const auto steps = std::lround(seconds / step_s);
  for (long i = 0; i <= steps; ++i) {
    const double t_s = static_cast<double>(i) * step_s;
    builder.advance(kicking::nanoseconds(t_s), place(t_s));
    while (auto scan = builder.take()) scans.push_back(std::move(*scan));
  }
  return scans;
}

std::vector<Scan> empty_scans(const LaserModel& laser, double seconds) {
  return scans_of(laser, seconds, [](double) { return std::nullopt; });
}

double elevation(const LaserModel& laser, std::size_t beam) {
  const double angle = laser.geometry.first_angle_rad + static_cast<double>(beam) * laser.geometry.step_rad;
  return laser.front_elevation_rad + (laser.mirrored ? -angle : angle);
}

int hits(const Scan& scan, const Scan& background) {
  int count = 0;
  for (std::size_t i = 0; i < scan.range_mm.size(); ++i) count += scan.range_mm[i] != background.range_mm[i];
  return count;
}

TEST(ScanBuilder, SeesFloorWallsAndCeiling) {
  LaserModel laser = noiseless();
  laser.z_m = 0.5;
  laser.wall_ahead_m = 5.0;
  laser.wall_behind_m.reset();
  laser.ceiling_m = 4.5;
  const Scan scan = empty_scans(laser, 0.03).at(0);
  const auto range_m = [&](double elevation_deg) {
    const auto beam = std::lround((elevation_deg + 45.0) * 4.0);
    EXPECT_NEAR(elevation(laser, static_cast<std::size_t>(beam)) * 180.0 / std::numbers::pi, elevation_deg, 1e-9);
    return scan.range_mm[static_cast<std::size_t>(beam)] / 1000.0;
  };
  EXPECT_NEAR(range_m(0.0), 5.0, 0.001);
  EXPECT_NEAR(range_m(-30.0), 1.0, 0.001);
  EXPECT_NEAR(range_m(30.0), 5.0 / std::cos(std::numbers::pi / 6.0), 0.001);
  EXPECT_NEAR(range_m(90.0), 4.0, 0.001);
  EXPECT_NEAR(range_m(150.0), 8.0, 0.001);
  EXPECT_EQ(range_m(180.0), 0.001) << "nothing there: an error code";
  EXPECT_NEAR(range_m(210.0), 1.0, 0.001);
}

TEST(ScanBuilder, MeasuresTheBallWhereItIsAtEachBeamsTime) {
  const LaserModel laser = noiseless();
  const Eigen::Vector3d start{3.0, 0.0, 1.0}, velocity{6.0, 0.0, 3.0};
  const auto place = [&](double t) {
    return std::optional(Eigen::Vector3d{start.x() + velocity.x() * t, 0.0, start.z() + velocity.z() * t});
  };
  const auto scans = scans_of(laser, 0.1, place);
  ASSERT_EQ(scans.size(), 4u);
  int seen = 0;
  for (const Scan& scan : scans) {
    for (std::size_t i = 0; i < scan.range_mm.size(); ++i) {
      const double t = kicking::seconds(scan.t_ns) + static_cast<double>(i) * laser.geometry.beam_period_s;
      const Eigen::Vector3d ball = *place(t);
      const double x = ball.x() - laser.x_m, z = ball.z() - laser.z_m, distance = std::hypot(x, z);
      const double off = elevation(laser, i) - std::atan2(z, x), q = distance * std::sin(off);
      if (std::cos(off) < 0.0 || std::abs(q) >= kRadius_m) continue;
      const double range = distance * std::cos(off) - std::sqrt(kRadius_m * kRadius_m - q * q);
      ASSERT_NEAR(scan.range_mm[i] / 1000.0, range, 0.0006) << "beam " << i;
      ++seen;
    }
  }
  EXPECT_GT(seen, 60);
}

TEST(ScanBuilder, DoesNotDependOnTheStepsOfTheWorld) {
  const LaserModel laser;
  const auto place = [](double t) { return std::optional(Eigen::Vector3d{2.0 + 5.0 * t, 0.01, 0.5 + 2.0 * t}); };
  const auto coarse = scans_of(laser, 0.2, place, 1e-3), fine = scans_of(laser, 0.2, place, 1e-4);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t j = 0; j < coarse.size(); ++j) EXPECT_EQ(coarse[j].range_mm, fine[j].range_mm);
}

TEST(ScanBuilder, IsFixedBySeedAndOpportunity) {
  const LaserModel laser;
  const auto scan = [&](const kicking::Draws& draws) {
    return scans_of(
               laser, 0.03, [](double) { return std::nullopt; }, 1e-3, draws)
        .at(0)
        .range_mm;
  };
  EXPECT_EQ(scan({5, 1}), scan({5, 1}));
  EXPECT_NE(scan({5, 1}), scan({6, 1}));
  EXPECT_NE(scan({5, 1}), scan({5, 2}));
  ScanBuilder builder(laser, kRadius_m, {5, 1});
  builder.use({5, 2});
  builder.advance(30'000'000, std::nullopt);
  EXPECT_EQ(builder.take()->range_mm, scan({5, 2}));
}

TEST(ScanBuilder, HasTheNoiseAndDropoutsThatTheModelNames) {
  LaserModel laser;
  laser.mixed_ratio = 0.0;
  const auto scans = empty_scans(laser, 5.0);
  const Scan truth = empty_scans(noiseless(), 0.03).at(0);
  double sum = 0.0, squares = 0.0;
  int returns = 0, dropouts = 0;
  for (const Scan& scan : scans) {
    for (std::size_t i = 0; i < scan.range_mm.size(); ++i) {
      if (truth.range_mm[i] < 20) continue;
      if (scan.range_mm[i] < 20) {
        ++dropouts;
        continue;
      }
      const double error = static_cast<double>(scan.range_mm[i]) - static_cast<double>(truth.range_mm[i]);
      sum += error;
      squares += error * error;
      ++returns;
    }
  }
  EXPECT_NEAR(sum / returns, 0.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / returns), 10.0, 0.1);
  EXPECT_NEAR(static_cast<double>(dropouts) / (returns + dropouts), 0.005, 0.0006);
}

TEST(ScanBuilder, MixesPixelsAtTheBallsEdges) {
  LaserModel laser = noiseless();
  const auto place = [](double) { return std::optional(Eigen::Vector3d{5.0, 0.0, 1.5}); };
  const auto clean = scans_of(laser, 0.03, place).at(0);
  laser.mixed_ratio = 0.3;
  const auto scans = scans_of(laser, 20.0, place);
  const auto background = empty_scans(noiseless(), 0.03).at(0);
  int first = 0;
  while (clean.range_mm[first] == background.range_mm[first]) ++first;
  int mixed = 0;
  for (const Scan& scan : scans) {
    const int beyond = hits(scan, background) - hits(clean, background);
    EXPECT_LE(beyond, 2);
    mixed += beyond;
    if (scan.range_mm[first - 1] == background.range_mm[first - 1]) continue;
    EXPECT_GE(scan.range_mm[first - 1], clean.range_mm[first]);
    EXPECT_LE(scan.range_mm[first - 1], clean.range_mm[first] + 501);
  }
  EXPECT_NEAR(mixed / (2.0 * static_cast<double>(scans.size())), 0.3, 0.035);
}

TEST(ScanBuilder, BallBesideThePlaneLooksSmallerAndVanishes) {
  const LaserModel laser = noiseless();
  const auto background = empty_scans(laser, 0.03).at(0);
  const auto covered = [&](double off_m) {
    const auto scans = scans_of(laser, 0.03, [&](double) { return std::optional(Eigen::Vector3d{4.0, off_m, 1.05}); });
    return hits(scans.at(0), background) * laser.geometry.step_rad;
  };
  for (const double off : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
    const double visible = std::sqrt(kRadius_m * kRadius_m - off * off);
    EXPECT_NEAR(covered(off), 2.0 * std::asin(visible / 1.0), 1.1 * laser.geometry.step_rad) << off;
  }
  EXPECT_EQ(covered(0.1101), 0.0);
  EXPECT_EQ(covered(-0.2), 0.0);
}

TEST(ScanBuilder, SeesTheSameWhereverItStandsInTheField) {
  const LaserModel along_x = noiseless();
  const auto expected = scans_of(along_x, 0.1, [](double t) {
    return std::optional(Eigen::Vector3d{6.0 * t, 0.05, 0.5});
  });
  for (const double heading : {0.0, 0.7, -2.5}) {
    const Eigen::Vector3d u{-std::sin(heading), std::cos(heading), 0.0},
        left{-std::cos(heading), -std::sin(heading), 0.0};
    const Eigen::Vector3d origin{1.5, -2.0, 0.0};
    const auto placed = [&](double along, double to_left, double z) {
      return Eigen::Vector3d{origin.x() + along * u.x() + to_left * left.x(),
                             origin.y() + along * u.y() + to_left * left.y(), z};
    };
    LaserModel laser = noiseless();
    const Eigen::Vector3d at = placed(4.0, 0.0, 0.0);
    laser.x_m = at.x();
    laser.y_m = at.y();
    laser.heading_rad = heading;
    const auto scans = scans_of(laser, 0.1, [&](double t) { return std::optional(placed(6.0 * t, 0.05, 0.5)); });
    EXPECT_NEAR(mount_of(laser, placed(0.0, 0.0, 0.11)).x_m, 4.0, 1e-12);
    ASSERT_EQ(scans.size(), expected.size());
    for (std::size_t j = 0; j < scans.size(); ++j) {
      for (std::size_t i = 0; i < scans[j].range_mm.size(); ++i)
        ASSERT_NEAR(static_cast<double>(scans[j].range_mm[i]), static_cast<double>(expected[j].range_mm[i]), 1.0);
    }
  }
}

TEST(ScanBuilder, LyingOnItsOtherSideItLooksTheOtherWayRound) {
  LaserModel laser = noiseless();
  laser.z_m = 0.3;
  const auto place = [](double) { return std::optional(Eigen::Vector3d{3.0, 0.0, 1.0}); };
  auto scan = scans_of(laser, 0.03, place).at(0).range_mm;
  laser.mirrored = true;
  const auto mirrored = scans_of(laser, 0.03, place).at(0).range_mm;
  std::reverse(scan.begin(), scan.end());
  for (std::size_t i = 0; i < scan.size(); ++i)
    ASSERT_NEAR(static_cast<double>(scan[i]), static_cast<double>(mirrored[i]), 1.0);
}

TEST(ScanBuilder, GivesAScanWhenItsLastBeamWasMeasured) {
  const LaserModel laser = noiseless();
  ScanBuilder builder(laser, kRadius_m, kDraws, 7'000'000);
  const auto last_ns = 7'000'000 + kicking::nanoseconds(1080 * laser.geometry.beam_period_s);
  builder.advance(last_ns - 1, std::nullopt);
  EXPECT_FALSE(builder.take());
  builder.advance(last_ns, std::nullopt);
  EXPECT_EQ(builder.take()->t_ns, 7'000'000);
  EXPECT_FALSE(builder.take());
  builder.advance(7'000'000 + 3 * 25'000'000, std::nullopt);
  EXPECT_EQ(builder.take()->t_ns, 32'000'000);
  EXPECT_EQ(builder.take()->t_ns, 57'000'000);
  EXPECT_FALSE(builder.take());
}

TEST(ScanBuilder, BallThatComesOrGoesIsThereOnlyBetweenTwoSights) {
  const LaserModel laser = noiseless();
  const auto background = empty_scans(laser, 0.03).at(0);
  const auto scans = scans_of(laser, 0.2, [](double t) {
    return t > 0.049 && t < 0.101 ? std::optional(Eigen::Vector3d{3.0, 0.0, 1.0}) : std::nullopt;
  });
  std::vector<int> seen;
  for (const Scan& scan : scans) seen.push_back(hits(scan, background) > 0);
  EXPECT_EQ(seen, (std::vector<int>{0, 0, 1, 1, 0, 0, 0, 0}));
}

TEST(ScanBuilder, RefusesTimeThatGoesBackAndGeometriesThatMakeNoSense) {
  ScanBuilder builder(LaserModel{}, kRadius_m, kDraws);
  builder.advance(2'000'000, std::nullopt);
  EXPECT_THROW(builder.advance(1'999'999, std::nullopt), std::invalid_argument);
  LaserModel laser;
  laser.geometry.beams = 0;
  EXPECT_THROW(ScanBuilder(laser, kRadius_m, kDraws), std::invalid_argument);
  laser = {};
  laser.geometry.scan_period_s = 0.0;
  EXPECT_THROW(ScanBuilder(laser, kRadius_m, kDraws), std::invalid_argument);
}

TEST(SyntheticRecord, HoldsBackgroundAndThenEachKickAsItsTruthSays) {
  const LaserModel laser = noiseless();
  RecordPlan plan;
  plan.kicks = {{7.0, 0.6, 0.25, 20.0}, {9.0, 0.7, 0.0, std::nullopt}};
  const SyntheticRecord record = synthesize_record(laser, plan, {}, 3);
  EXPECT_EQ(record.mount.x_m, 4.0);
  EXPECT_EQ(record.mount.z_m, 0.05);
  ASSERT_EQ(record.truth.size(), 2u);
  EXPECT_EQ(record.truth[0].kick.power, 20.0);
  EXPECT_FALSE(record.truth[1].kick.power);
  for (const KickedTruth& truth : record.truth) {
    EXPECT_GE(truth.launch_t_ns, 2'600'000'000);
    // Where the ball is in the scan that sees it 0.3 s later.
    BallPhysics ball;
    ball.drag_coefficient = truth.kick.drag_coefficient;
    BallMotion motion{{{0.0, 0.0, 0.11},
                       {truth.kick.exit_speed_mps * std::cos(truth.kick.exit_angle_rad), 0.0,
                        truth.kick.exit_speed_mps * std::sin(truth.kick.exit_angle_rad)}}};
    for (int i = 0; i < 300; ++i) advance(motion, ball, 1e-3);
    const double x = motion.position_m.x() - laser.x_m, z = motion.position_m.z() - laser.z_m;
    const auto after = std::find_if(record.scans.begin(), record.scans.end(), [&](const Scan& s) {
      return s.t_ns + 25'000'000 > truth.launch_t_ns + 300'000'000;
    });
    const auto beam = std::lround((std::atan2(z, x) - elevation(laser, 0)) / laser.geometry.step_rad);
    const double seen_m = after->range_mm[static_cast<std::size_t>(beam)] / 1000.0;
    EXPECT_NEAR(seen_m, std::hypot(x, z) - kRadius_m, 0.15);
  }
  for (std::size_t j = 1; j < record.scans.size(); ++j)
    ASSERT_EQ(record.scans[j].t_ns - record.scans[j - 1].t_ns, 25'000'000);
  EXPECT_NEAR(static_cast<double>(record.scans.size()), 40.0 * (2.0 + 2 * (0.6 + 2.4 + 0.5)), 3.0);
  for (std::size_t j = 0; j < 79; ++j) ASSERT_EQ(record.scans[j].range_mm, record.scans[0].range_mm);
  EXPECT_NE(record.scans[85].range_mm, record.scans[0].range_mm) << "the ball lies there";
}

TEST(SyntheticRecord, IsFixedByItsSeed) {
  RecordPlan plan;
  plan.kicks = {{8.0, 0.64, 0.25, std::nullopt}};
  const auto one = synthesize_record({}, plan, {}, 3), same = synthesize_record({}, plan, {}, 3);
  const auto other = synthesize_record({}, plan, {}, 4);
  ASSERT_EQ(one.scans.size(), same.scans.size());
  for (std::size_t j = 0; j < one.scans.size(); ++j) ASSERT_EQ(one.scans[j].range_mm, same.scans[j].range_mm);
  EXPECT_EQ(one.truth[0].launch_t_ns, same.truth[0].launch_t_ns);
  EXPECT_NE(one.truth[0].launch_t_ns, other.truth[0].launch_t_ns);
  EXPECT_NE(one.scans[0].range_mm, other.scans[0].range_mm);
}

}  // namespace
}  // namespace trivela::sim
