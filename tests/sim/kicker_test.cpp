#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "kicking/geometry/time.hpp"
#include "kicking/model/robot_model.hpp"
#include "sim/kicker/kicker.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::sim {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
const kicking::Draws kDraws{1, 1};

Kicker quiet() {
  Kicker k;
  k.delay_sd_s = k.speed_sd_ratio = k.direction_sd_rad = 0.0;
  return k;
}

/// The stroke of an order at t = 0.
Stroke stroke_of(KickerDevice& device, double power, std::uint32_t attempt = 0) {
  device.order({.t_ns = 0, .kick_id = 9, .power = power});
  device.energise_due(0, true, kDraws, attempt);
  return device.take_released(std::numeric_limits<std::int64_t>::max()).value();
}

TEST(KickerTable, DefaultIsTheTrueTableBehindThePublishedEffectiveOne) {
  const double published_mps[] = {5.97, 7.33, 8.39, 9.21, 9.82, 10.18, 10.44, 10.51};
  const Kicker kicker;
  for (std::size_t i = 0; i < kicker.powers.size(); ++i) {
    EXPECT_DOUBLE_EQ(kicker.powers[i], 15.0 + 5.0 * static_cast<double>(i));
    const Exit seen = effective_exit({kicker.exit_speeds_mps[i], kicker.exit_elevations_rad[i]}, BallPhysics{});
    EXPECT_NEAR(seen.speed_mps, published_mps[i], 1e-3);
    EXPECT_NEAR(seen.elevation_rad, 36.78 * kDegree_rad, 1e-3);
    const Exit exit = true_exit({published_mps[i], 36.78 * kDegree_rad}, BallPhysics{});
    EXPECT_NEAR(exit.speed_mps, kicker.exit_speeds_mps[i], 1e-3);
    EXPECT_NEAR(exit.elevation_rad, kicker.exit_elevations_rad[i], 1e-3);
  }
}

TEST(KickerTable, ApexAndRangeGiveTheEffectiveExitOfTheVectors) {
  for (const auto& row : tests::rows("drag_trajectory.csv")) {
    SCOPED_TRACE(row.where());
    BallPhysics ball;
    ball.drag_coefficient = row.number("Cd");
    const Exit seen = effective_exit({row.number("v0_mps"), row.number("theta_deg") * kDegree_rad}, ball);
    EXPECT_NEAR(seen.speed_mps, row.number("v0_effective_from_HD_mps"), 1e-4);
    EXPECT_NEAR(seen.elevation_rad / kDegree_rad, row.number("theta_effective_from_HD_deg"), 1e-3);
  }
}

TEST(KickerTable, RefusesALobThatIsNone) {
  EXPECT_THROW(effective_exit({8.0, 0.0}, BallPhysics{}), std::runtime_error);
  EXPECT_THROW(effective_exit({0.0, 0.6}, BallPhysics{}), std::runtime_error);
}

TEST(KickerTable, IsLinearBetweenItsSetPointsAndEndsAtThem) {
  const Kicker k;
  EXPECT_DOUBLE_EQ(exit_at(k, 22.5).speed_mps, (k.exit_speeds_mps[1] + k.exit_speeds_mps[2]) / 2);
  EXPECT_DOUBLE_EQ(exit_at(k, 30.0).elevation_rad, k.exit_elevations_rad[3]);
  EXPECT_DOUBLE_EQ(exit_at(k, -3.0).speed_mps, k.exit_speeds_mps.front());
  EXPECT_DOUBLE_EQ(exit_at(k, 1e9).speed_mps, k.exit_speeds_mps.back());
}

TEST(KickerDevice, ReleasesTheTableExitAfterItsDelay) {
  KickerDevice device{quiet()};
  device.order({.t_ns = 5'000'000, .kick_id = 9, .power = 25});
  EXPECT_EQ(device.next_event_t_ns(), 5'000'000);
  device.energise_due(4'999'999, true, kDraws, 0);
  EXPECT_FALSE(device.stroke());
  device.energise_due(5'000'000, true, kDraws, 0);
  EXPECT_EQ(device.next_event_t_ns(), 65'000'000);
  EXPECT_FALSE(device.take_released(64'999'999));
  const auto stroke = device.take_released(65'000'000);
  ASSERT_TRUE(stroke);
  EXPECT_EQ(stroke->kick_id, 9);
  EXPECT_DOUBLE_EQ(stroke->exit_speed_mps, Kicker{}.exit_speeds_mps[2]);
  EXPECT_FALSE(device.take_released(65'000'000));
}

TEST(KickerDevice, DrainsByTheSpeedSquaredAndRecharges) {
  KickerDevice device{quiet()};
  stroke_of(device, 50);
  EXPECT_DOUBLE_EQ(device.charge(), 0.5);
  device.recharge(0.3);
  EXPECT_NEAR(device.charge(), 0.5 + 0.3 * 0.333, 1e-12);
  device.recharge(100.0);
  EXPECT_DOUBLE_EQ(device.charge(), 1.0);
  stroke_of(device, 15);
  EXPECT_NEAR(device.charge(), 1.0 - 0.5 * std::pow(6.087298 / 11.175526, 2), 1e-9);
}

TEST(KickerDevice, KicksWeaklyWithoutChargeAndNeverGoesBelowZero) {
  KickerDevice device{quiet()};
  const double full = stroke_of(device, 50).exit_speed_mps;
  stroke_of(device, 50);
  EXPECT_DOUBLE_EQ(device.charge(), 0.0);
  EXPECT_DOUBLE_EQ(stroke_of(device, 50).exit_speed_mps, 0.0);
  device.recharge(0.125 / 0.333);
  EXPECT_NEAR(stroke_of(device, 50).exit_speed_mps, full / 2, 1e-9);
  EXPECT_DOUBLE_EQ(device.charge(), 0.0);
}

TEST(KickerDevice, IgnoresAPowerThatIsNoNumberAndOrdersDuringAKick) {
  KickerDevice device{quiet()};
  device.order({.t_ns = 0, .kick_id = 1, .power = std::nan("")});
  EXPECT_FALSE(device.next_event_t_ns());
  device.order({.t_ns = 0, .kick_id = 2, .power = 20});
  device.order({.t_ns = 0, .kick_id = 3, .power = 50});
  device.energise_due(0, true, kDraws, 0);
  device.order({.t_ns = 0, .kick_id = 4, .power = 50});
  EXPECT_EQ(device.take_released(1'000'000'000)->kick_id, 2);
  EXPECT_FALSE(device.next_event_t_ns());
}

TEST(KickerDevice, HasTheNoiseThatTheScenarioNames) {
  constexpr std::uint32_t kCount = 4000;
  const Kicker k;
  double delay = 0, delay2 = 0, speed = 0, speed2 = 0, turn = 0, turn2 = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    KickerDevice device{k};
    const Stroke s = stroke_of(device, 25, i);
    const double d = kicking::seconds(s.release_t_ns), v = s.exit_speed_mps / k.exit_speeds_mps[2] - 1.0;
    delay += d, delay2 += d * d, speed += v, speed2 += v * v, turn += s.deflection_rad;
    turn2 += s.deflection_rad * s.deflection_rad;
  }
  const auto sd = [](double sum, double squares) { return std::sqrt(squares / kCount - std::pow(sum / kCount, 2)); };
  EXPECT_NEAR(delay / kCount, 0.060, 0.001);
  EXPECT_NEAR(sd(delay, delay2), 0.015, 0.001);
  EXPECT_NEAR(speed / kCount, 0.0, 0.0015);
  EXPECT_NEAR(sd(speed, speed2), 0.02, 0.001);
  EXPECT_NEAR(turn / kCount, 0.0, 0.0018);
  EXPECT_NEAR(sd(turn, turn2), 1.5 * kDegree_rad, 0.0013);
}

Kicker with_lever() {
  Kicker k = quiet();
  k.flat.enabled = true;
  k.flat.delay_sd_s = k.flat.speed_sd_ratio = k.flat.direction_sd_rad = 0.0;
  k.flat.delay_s = 0.04;
  k.flat.lever_s = 0.2;
  return k;
}

TEST(KickerDevice, TheLeverTakesItsTimeAndThenTheKickIsFlat) {
  KickerDevice device{with_lever()};
  device.reset(1.0);
  EXPECT_EQ(device.lever_kind(0), 0);
  device.lever(1, 0);
  EXPECT_EQ(device.lever_kind(kicking::nanoseconds(0.19)), kicking::kLeverMoves);
  device.lever(0, kicking::nanoseconds(0.1));
  EXPECT_EQ(device.lever_kind(kicking::nanoseconds(0.2)), 1) << "a moving lever ignores another wish";
  const std::int64_t t_ns = kicking::nanoseconds(0.2);
  device.order({.t_ns = t_ns, .kick_id = 9, .power = 50.0});
  device.energise_due(t_ns, true, kDraws, 0);
  const Stroke flat = device.take_released(std::numeric_limits<std::int64_t>::max()).value();
  EXPECT_DOUBLE_EQ(flat.exit_elevation_rad, with_lever().flat.exit_elevations_rad.back());
  EXPECT_DOUBLE_EQ(flat.exit_speed_mps, 11.0);
  EXPECT_EQ(flat.release_t_ns, t_ns + kicking::nanoseconds(0.04));
  device.reset(1.0);
  EXPECT_EQ(stroke_of(device, 50.0).exit_elevation_rad, Kicker{}.exit_elevations_rad.back()) << "back at the lob";
}

TEST(KickerDevice, KicksAsBeforeWhileTheLeverMovesOrWhereThereIsNone) {
  KickerDevice moving{with_lever()}, none{quiet()};
  for (KickerDevice* device : {&moving, &none}) {
    device->reset(1.0);
    device->lever(1, 0);
    EXPECT_EQ(stroke_of(*device, 50.0).exit_elevation_rad, Kicker{}.exit_elevations_rad.back());
  }
  EXPECT_EQ(none.lever_kind(kicking::nanoseconds(10.0)), 0);
}

TEST(Release, AddsTheVelocityOfTheBallsPoint) {
  const Stroke stroke{.kick_id = 0,
                      .release_t_ns = 0,
                      .exit_speed_mps = 10.0,
                      .exit_elevation_rad = std::asin(0.6),
                      .deflection_rad = 0.0,
                      .live = true};
  // Facing -x of F (heading 90 degrees): forward is -x, right is +y.
  const BallMotion m = release(stroke, {1.0, 2.0, std::numbers::pi / 2}, {0.4, 1.5, 2.0}, Kicker{}, 0.27, 0.11);
  EXPECT_NEAR(m.position_m.x(), 0.73, 1e-12);
  EXPECT_NEAR(m.position_m.y(), 2.0, 1e-12);
  EXPECT_NEAR(m.velocity_mps.x(), -(8.0 + 1.5), 1e-12);
  EXPECT_NEAR(m.velocity_mps.y(), 0.4 - 2.0 * 0.27, 1e-12);
  EXPECT_NEAR(m.velocity_mps.z(), 6.0, 1e-12);
}

TEST(Release, KeepsForwardAndBackwardTransferApart) {
  Kicker k;
  k.transfer_forward_ratio = 0.5;
  k.transfer_backward_ratio = 0.25;
  k.transfer_lateral_ratio = 0.0;
  const Stroke stroke{.kick_id = 0,
                      .release_t_ns = 0,
                      .exit_speed_mps = 5.0,
                      .exit_elevation_rad = 0.0,
                      .deflection_rad = 0.0,
                      .live = true};
  EXPECT_DOUBLE_EQ(release(stroke, {}, {1.0, 2.0, 0.0}, k, 0.27, 0.11).velocity_mps.y(), 6.0);
  EXPECT_DOUBLE_EQ(release(stroke, {}, {1.0, -2.0, 0.0}, k, 0.27, 0.11).velocity_mps.y(), 4.5);
  EXPECT_DOUBLE_EQ(release(stroke, {}, {1.0, 2.0, 3.0}, k, 0.27, 0.11).velocity_mps.x(), 0.0);
}

}  // namespace
}  // namespace trivela::sim
