#include "calibration/rows/drive_rows.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "calibration/rows/recorded_drives.hpp"
#include "kicking/fit/scatter_fit.hpp"
#include "kicking/geometry/time.hpp"
#include "tests/calibration/drive_log.hpp"

namespace trivela::calibration {
namespace {

using Int = std::int64_t;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(DriveLog, LateralKicksGiveTheTransferThatMadeThem) {
  for (const double vx : {-1.5, -0.8, 0.5, 1.0, 2.0}) {
    for (const double heading : {-0.2, 0.0, 0.15})
      kick("lateral_drive", {0.4, 2.5, heading}, {vx, 0.0, 0.0}, {1, 1, 0.8});
  }
  kick("moving", {0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}, {});
  const auto kicks = lateral_kicks(recorded_drives(read()), {});
  ASSERT_EQ(kicks.rows.size(), 15u);
  EXPECT_THAT(kicks.left_out, IsEmpty());
  const auto fit = kicking::fit_deflection(kicks.rows, kDelay_s);
  EXPECT_NEAR(fit.lateral->slope.value, 0.8, 1e-9);
  EXPECT_NEAR(fit.lateral->rms, 0.0, 1e-9);
  // By hand, heading 0: y = 9 - 2.5 - 0.27 m from the ball, the ball goes right with the robot.
  EXPECT_NEAR(kicks.rows[1].distance_m, 6.23, 1e-12);
  EXPECT_LT(kicks.rows[1].b_m, 0.0);
}

TEST_F(DriveLog, TurnKicksGiveTheDelayThatMadeThem) {
  for (const double omega : {-2.0, -1.0, 0.5, 1.0, 2.0}) {
    kick("turn_drive", {0.0, 3.0, 0.1 * omega}, {0.0, 0.0, omega}, {1, 1, 1});
  }
  const auto kicks = turn_kicks(recorded_drives(read()), {}, 0.02);
  ASSERT_EQ(kicks.rows.size(), 5u);
  for (const auto& row : kicks.rows) EXPECT_GT(row.allowed_error_m, 0.0) << row.omega_radps;
  const auto fit = kicking::fit_rotation(kicks.rows, kicking::RotationLever{0.27, 0.02});
  // The model takes the lever's part from the centre, the flight from the ball: 1 ms at 6 m.
  EXPECT_NEAR(fit.delay->slope.value, kDelay_s, 0.002);
  EXPECT_NEAR(fit.line.slope.value, kDelay_s + 0.01 + 0.27 / 6.72, 0.003);
}

TEST_F(DriveLog, StraightKicksGiveTheTransferThatMadeThem) {
  const kicking::RobotModel model;
  for (const double vy : {0.0, 0.0, -1.0, -0.5, 0.5, 1.0}) {
    kick("straight_drive", {0.1, 3.0, 0.02}, {0.0, vy, 0.0}, std::nullopt, std::nullopt);  // crossings play no part
    see_flight(6.6, 5.0, (vy > 0.0 ? 0.9 : 0.6) * vy);
  }
  kick("straight_drive", {0.1, 3.0, 0.02}, {0.0, 1.0, 0.0}, {0.2, 0.2, 1});  // nobody sees it fly
  const auto kicks = transfer_kicks(recorded_drives(read()), model);
  EXPECT_THAT(kicks.left_out, ElementsAre("1 kick left out: the flight camera saw too little of the flight"));
  ASSERT_EQ(kicks.rows.size(), 6u);
  for (const auto& row : kicks.rows) {
    EXPECT_NEAR(row.track->up_mps, 5.0, 0.002) << row.vy_mps;
    EXPECT_NEAR(row.distance_m, 6.0 / std::cos(0.02) - 0.27, 0.01);
  }
  const auto fit = kicking::fit_transfer(kicks.rows, kDelay_s);
  const double effective = model.table.speed_for(kPower) * std::cos(model.exit_angle_rad) / 6.6;
  EXPECT_NEAR(fit.forward->exact.value, 0.9 * effective, 2e-3);
  EXPECT_NEAR(fit.backward->exact.value, 0.6 * effective, 2e-3);
}

TEST_F(DriveLog, KicksWithoutACrossingOrRefusedAreLeftOut) {
  kick("lateral_drive", {0, 3, 0}, {1, 0, 0}, std::nullopt, std::nullopt);
  kick("lateral_drive", {0, 3, 0}, {1, 0, 0}, 0.5, 0.5, false);
  kick("lateral_drive", {0, 3, 3.1}, {1, 0, 0}, 0.5, 0.5);
  const auto kicks = lateral_kicks(recorded_drives(read()), {});
  EXPECT_THAT(kicks.rows, IsEmpty());
  EXPECT_THAT(kicks.left_out, ElementsAre("1 kick left out: not seen to cross the goal line",
                                          "1 kick left out: the robot pointed away from the goal line"));
}

/// The ball held at v until the release, then in flight with drag, seen at 50 Hz with an offset of the frames.
std::vector<kicking::Sighting> seen_release(Int order_t_ns, double delay_s, double vx, double vy,
                                            double noise_m = 0.0) {
  std::vector<kicking::Sighting> sightings;
  const kicking::RobotModel model;
  const double k = kicking::drag_per_m({}, {});
  Eigen::Vector3d ball(0.3, 3.0, 0.11);
  Eigen::Vector3d velocity(vx, vy, 0.0);
  ball += velocity * -0.3;
  bool released = false;
  int frame = 0;
  constexpr double kStep_s = 1e-4;
  for (int i = 0; i < 7000; ++i) {
    const double t_s = -0.3 + kStep_s * i;
    if (i % 200 == 70) {
      const double sign = frame++ % 2 == 0 ? 1.0 : -1.0;
      sightings.push_back({order_t_ns + kicking::nanoseconds(t_s), ball + sign * noise_m * Eigen::Vector3d(1, 1, 1)});
    }
    if (!released && t_s + 0.5 * kStep_s >= delay_s) {
      released = true;
      velocity += Eigen::Vector3d(0.0, 6.6, 4.9);
    }
    if (released) velocity += kStep_s * (Eigen::Vector3d(0, 0, -9.81) - k * velocity.norm() * velocity);
    ball += kStep_s * velocity;
  }
  return sightings;
}

TEST(LaunchTrack, IsTheFlightsOwnWhereverTheReleaseIsThoughtToBe) {
  const auto sightings = seen_release(0, 0.06, 0.0, 0.5);
  for (const std::int64_t release_t_ns : {30'000'000, 60'000'000, 90'000'000}) {
    const auto track = launch_track(sightings, release_t_ns, 9.0, {});
    ASSERT_TRUE(track);
    EXPECT_NEAR(track->velocity_mps.y(), 7.1, 0.01);
    EXPECT_NEAR(track->velocity_mps.z(), 4.9, 0.02);
  }
  EXPECT_FALSE(launch_track({}, 0, 9.0, {}));
}

TEST(ReleaseTrack, FindsTheInstantAtWhichTheTracksMeet) {
  for (const double delay_s : {0.0, 0.03, 0.06, 0.14}) {
    for (const double vx : {-2.0, 0.0, 1.0}) {
      for (const double vy : {-1.0, 0.0, 1.5}) {
        const auto found = release_delay_s(seen_release(5'000'000'000, delay_s, vx, vy), 5'000'000'000);
        ASSERT_TRUE(found);
        EXPECT_NEAR(*found, delay_s, 0.0005) << vx << " " << vy;
      }
    }
  }
}

TEST(ReleaseTrack, HoldsWithTheNoiseOfTheCamera) {
  EXPECT_NEAR(*release_delay_s(seen_release(0, 0.06, 0.5, 0.0, 0.03), 0), 0.06, 0.01);
}

TEST(ReleaseTrack, HasNoDelayWithoutEnoughSightings) {
  auto sightings = seen_release(0, 0.06, 0.0, 0.0);
  EXPECT_FALSE(release_delay_s(std::span(sightings).subspan(12), 0));  // none held
  EXPECT_FALSE(release_delay_s(std::span(sightings).first(20), 0));    // too few in flight
  EXPECT_FALSE(release_delay_s({}, 0));
}

TEST_F(DriveLog, DelaysComeFromTheFlightCameraOfKicksThatDoNotTurn) {
  const std::vector<double> delays{0.05, 0.06, 0.07};
  for (std::size_t i = 0; i < delays.size(); ++i) {
    const Int order_t_ns = static_cast<Int>(i + 1) * 1'000'000'000;
    kick("standing_drive", {0, 3, 0}, {0, 0, 0}, 0.0, 0.7);
    for (const kicking::Sighting& s : seen_release(order_t_ns, delays[i], 0.0, 0.0)) {
      writer_.push(frames_, {Int{1}, ++seq_, s.t_ns, s.t_ns, Int{1}, s.ball_m.x(), s.ball_m.y(), s.ball_m.z()});
    }
  }
  kick("turn_drive", {0, 3, 0}, {0, 0, 1.0}, 0.0, 0.7);
  kick("standing_drive", {0, 3, 0}, {0, 0, 0}, 0.0, 0.7);  // no frames
  const auto found = release_delays(recorded_drives(read()));
  ASSERT_EQ(found.rows.size(), 3u);
  for (std::size_t i = 0; i < delays.size(); ++i) EXPECT_NEAR(found.rows[i], delays[i], 0.0005);
  EXPECT_THAT(found.left_out, ElementsAre("1 kick left out: the robot turned",
                                          HasSubstr("the flight camera saw too little of the release")));
  EXPECT_NEAR(kicking::fit_delay(found.rows).mean_s.value, 0.06, 0.0005);
}

TEST_F(DriveLog, DirectionsAreThoseOfTheBallAndEndWhereItIsCarriedBack) {
  for (const double vx : {-0.4, 0.0, 0.7}) {
    kick("standing_drive", {0, 3, 0.3}, {0, 0, 0}, 0.0, 0.7);  // the heading believed plays no part
    for (const kicking::Sighting& s : seen_release(kicks_ * 1'000'000'000, 0.06, vx, 0.0, 0.01)) {
      writer_.push(frames_, {Int{1}, ++seq_, s.t_ns, s.t_ns, Int{1}, s.ball_m.x(), s.ball_m.y(), s.ball_m.z()});
    }
  }
  kick("standing_drive", {0, 3, 0}, {0, 0, 0}, 0.0, 0.7);  // no frames
  const auto found = launch_directions(recorded_drives(read()), {});
  ASSERT_EQ(found.rows.size(), 3u);
  EXPECT_THAT(found.left_out, ElementsAre(HasSubstr("1 kick left out")));
  const std::vector<double> slopes{-0.4 / 6.6, 0.0, 0.7 / 6.6};
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    EXPECT_NEAR(found.rows[i].value, -std::atan(slopes[i]), 0.003) << i;
    EXPECT_LT(found.rows[i].se, 0.01);
  }
}

TEST(DriveRowsSql, NeverReadsTheSimulatorsTruth) {
  for (const char* const name :
       {"calibration/rows/drive_kicks", "calibration/rows/ball_sightings", "evaluator/metrics/predicted_kicks"}) {
    std::ifstream in(std::string(TRIVELA_SOURCE_DIR) + "/" + name + ".sql");
    const std::string sql{std::istreambuf_iterator<char>(in), {}};
    EXPECT_THAT(sql, HasSubstr("SELECT")) << name;
    EXPECT_THAT(sql, Not(HasSubstr("truth"))) << name;
    EXPECT_THAT(sql, Not(testing::ContainsRegex("(FROM|JOIN) kicks"))) << name << ": the view joins the truth";
  }
}

}  // namespace
}  // namespace trivela::calibration
