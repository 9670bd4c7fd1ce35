#include "kicking/lob/analyzer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "kicking/geometry/time.hpp"
#include "sim/laser/laser.hpp"
#include "tests/kicking/lob_scene.hpp"

namespace trivela::kicking::lob {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using tests::kick;
using tests::lobs_of;

/// Scans of things that move by themselves: for each beam the nearest of circles at the scan's time.
struct Disc {
  double x_m, z_m, radius_m;
};

std::vector<Scan> scans_of(const std::function<std::vector<Disc>(double)>& scene, double duration_s) {
  const ScanGeometry geometry;
  const LaserMount mount;
  sim::ScanBuilder empty(sim::LaserModel{}, 0.11, kicking::Draws{1, 1});
  std::vector<Scan> scans;
  const auto take = [&](double t_s) {
    empty.advance(nanoseconds(t_s), std::nullopt);
    while (auto scan = empty.take()) scans.push_back(std::move(*scan));
  };
  take(2.0);
  const std::size_t background = scans.size();
  take(2.0 + duration_s);
  for (std::size_t j = background; j < scans.size(); ++j) {
    for (std::size_t i = 0; i < geometry.beams; ++i) {
      const auto beam = static_cast<double>(i);
      const double t_s = seconds(scans[j].t_ns) - 2.0 + beam * geometry.beam_period_s;
      const double angle = mount.front_elevation_rad + geometry.first_angle_rad + beam * geometry.step_rad;
      for (const Disc& disc : scene(t_s)) {
        const double x = disc.x_m - mount.x_m, z = disc.z_m - mount.z_m;
        const double along = x * std::cos(angle) + z * std::sin(angle);
        const double q = x * std::sin(angle) - z * std::cos(angle);
        const double depth2 = disc.radius_m * disc.radius_m - q * q;
        if (along <= 0.0 || depth2 <= 0.0) continue;
        const double range_m = along - std::sqrt(depth2);
        if (range_m < 0.0) continue;  // the scanner is inside
        const auto range_mm = static_cast<std::uint32_t>(1000.0 * range_m);
        if (scans[j].range_mm[i] < 100 || range_mm < scans[j].range_mm[i]) scans[j].range_mm[i] = range_mm;
      }
    }
  }
  return scans;
}

std::vector<LobRecord> lobs_in(const std::vector<Scan>& scans) { return tests::lobs_in(scans, {}, {}); }

/// Two legs that swing, a body, an arm, a head.
std::vector<Disc> person(double x_m, double t_s) {
  const double swing = 0.35 * std::sin(2.0 * std::numbers::pi * t_s);
  return {{x_m + swing, 0.15, 0.10},       {x_m - swing, 0.15, 0.10}, {x_m + 0.6 * swing, 0.5, 0.11},
          {x_m - 0.6 * swing, 0.5, 0.11},  {x_m, 1.0, 0.22},          {x_m, 1.3, 0.25},
          {x_m + 0.8 * swing, 0.95, 0.09}, {x_m, 1.7, 0.12}};
}

TEST(NotALob, EmptyFieldAndNoReturnAtAll) {
  EXPECT_THAT(lobs_in(scans_of([](double) { return std::vector<Disc>{}; }, 2.0)), IsEmpty());
  const Scan nothing{0, std::vector<std::uint32_t>(ScanGeometry{}.beams, 1)};
  EXPECT_THAT(lobs_in(std::vector<Scan>(100, nothing)), IsEmpty());
}

TEST(NotALob, BallThatLiesOrRolls) {
  for (const double speed : {0.0, 0.5, 2.5, 5.0, 9.0}) {
    const auto scans = scans_of([&](double t) { return std::vector<Disc>{{speed * t, 0.11, 0.11}}; }, 2.5);
    EXPECT_THAT(lobs_in(scans), IsEmpty()) << speed << " m/s";
  }
}

TEST(NotALob, BallThatIsCarriedOrSwung) {
  const auto carried = [](double t) { return std::vector<Disc>{{1.5 * t, 0.9 + 0.05 * std::sin(9 * t), 0.11}}; };
  EXPECT_THAT(lobs_in(scans_of(carried, 3.0)), IsEmpty());
  // At the top of the swing it accelerates like a ball in the air.
  const auto swung = [](double t) {
    return std::vector<Disc>{{2.0 + 0.7 * std::sin(4 * t), 1.2 - 0.7 * std::cos(4 * t), 0.11}};
  };
  for (const LobRecord& lob : lobs_in(scans_of(swung, 4.0))) EXPECT_NE(lob.refusal, Refusal::kNone);
}

TEST(NotALob, PersonWhoWalksOrRunsThrough) {
  for (const double speed : {0.8, 1.5, 3.0}) {
    for (const LobRecord& lob : lobs_in(scans_of([&](double t) { return person(speed * t, t); }, 4.0)))
      EXPECT_NE(lob.refusal, Refusal::kNone) << speed << " m/s " << lob.centres.size();
  }
}

TEST(NotALob, Garbage) {
  const kicking::Draws draws{8, 1};
  const ScanGeometry geometry;
  std::vector<Scan> scans(300, Scan{0, std::vector<std::uint32_t>(geometry.beams, 1)});
  for (std::uint32_t j = 0; j < scans.size(); ++j) {
    scans[j].t_ns = 25'000'000 * static_cast<std::int64_t>(j);
    if (j < 40) continue;
    std::uint32_t range_mm = 0;
    for (std::uint32_t i = 0; i < geometry.beams; ++i) {
      // Now steps, now patches as wide as a ball.
      if (i % (1 + j % 20) == 0)
        range_mm = static_cast<std::uint32_t>(draws.uniform_in(0, 9e3, kicking::Role::kStart, j, i));
      scans[j].range_mm[i] = range_mm;
    }
  }
  for (const LobRecord& lob : lobs_in(scans)) EXPECT_NE(lob.refusal, Refusal::kNone);
}

TEST(Tracker, LobIsFoundWhileAPersonWalksBehindIt) {
  const auto scene = [](double t) {
    auto discs = person(7.5 - 1.2 * t, t);
    const double flown = t - 0.7, v_x = 8.39 * std::cos(radians(36.78)), v_z = 8.39 * std::sin(radians(36.78));
    if (flown > 0.0) {
      discs.push_back({v_x * flown, 0.11 + v_z * flown - 0.5 * kGravity_mps2 * flown * flown, 0.11});
    } else {
      discs.push_back({0.0, 0.11, 0.11});
    }
    return discs;
  };
  std::vector<LobRecord> accepted = lobs_in(scans_of(scene, 1.75));
  std::erase_if(accepted, [](const LobRecord& lob) { return lob.refusal != Refusal::kNone; });
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_NEAR(accepted[0].true_values->exit_speed_mps.value, 8.39, 0.03);
  EXPECT_NEAR(degrees(accepted[0].true_values->exit_angle_rad.value), 36.78, 0.2);
}

}  // namespace
}  // namespace trivela::kicking::lob
