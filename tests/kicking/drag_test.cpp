#include "kicking/ballistics/flight.hpp"

#include <gtest/gtest.h>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/kicking/reference_laws.hpp"
#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

double drag_of(double drag_coefficient) { return drag_per_m({}, {.drag_coefficient = drag_coefficient}); }

TEST(Drag, FlightsAgreeWithTheVectors) {
  for (const auto& row : tests::rows("drag_trajectory.csv")) {
    SCOPED_TRACE(row.where());
    const Ball ball{.mass_kg = row.number("mass_kg")};
    const double k = drag_per_m(ball, {row.number("rho"), row.number("Cd")});
    EXPECT_NEAR(k, row.number("k_per_m"), 1e-6);
    const DragFlight flight = fly_with_drag(row.number("v0_mps"), radians(row.number("theta_deg")), k);
    EXPECT_NEAR(flight.range_m, row.number("range_m"), 1e-5);
    EXPECT_NEAR(flight.t_flight_s, row.number("time_s"), 1e-5);
    EXPECT_NEAR(flight.apex_m, row.number("apex_m"), 1e-5);
    EXPECT_NEAR(flight.apex_x_m, row.number("x_apex_m"), 1e-5);
    const LobExit effective = exit_from_lob(flight.apex_m, flight.range_m);
    EXPECT_NEAR(degrees(effective.angle_rad), row.number("theta_effective_from_HD_deg"), 1e-4);
    EXPECT_NEAR(effective.speed_mps, row.number("v0_effective_from_HD_mps"), 1e-5);
  }
}

TEST(Drag, SpeedForACrossingAgreesWithTheVectors) {
  for (const auto& row : tests::rows("drag_v0_for_crossing.csv")) {
    SCOPED_TRACE(row.where());
    const FlightPoint point{row.number("d_m"), row.number("h_rel_m")};
    const double angle = radians(row.number("theta_deg"));
    const double k = drag_of(row.number("Cd"));
    const auto v0 = crossing_speed_with_drag(point, angle, k);
    ASSERT_TRUE(v0);
    EXPECT_NEAR(*v0, row.number("v0_drag"), 1e-5);
    EXPECT_NEAR(cross_with_drag(point.distance_m, *v0, angle, k).height_m, point.height_m, 1e-9);
    const DragCrossing slow = cross_with_drag(point.distance_m, row.number("v0_vacuum"), angle, k);
    EXPECT_NEAR(slow.height_m, row.number("height_with_drag_if_v0_vacuum"), 1e-5);
    EXPECT_NEAR(slow.t_flight_s, row.number("t_cross_s"), 1e-5);
  }
}

TEST(Drag, IntegrationOverTimeAndOverDistanceAgree) {
  for (const double v0 : {4.0, 8.0, 12.0}) {
    const DragFlight flight = fly_with_drag(v0, radians(40), drag_of(0.4));
    const DragCrossing landing = cross_with_drag(flight.range_m, v0, radians(40), drag_of(0.4));
    EXPECT_NEAR(landing.height_m, 0.0, 1e-8);
    EXPECT_NEAR(landing.t_flight_s, flight.t_flight_s, 1e-8);
  }
}

TEST(Drag, NoneIsVacuumAndMoreNeedsMoreSpeed) {
  const FlightPoint point{6.0, 0.5};
  double slower = *crossing_speed(point, radians(36.78));
  EXPECT_EQ(crossing_speed_with_drag(point, radians(36.78), 0.0), slower);
  for (const double cd : {0.1, 0.2, 0.3, 0.5}) {
    const double faster = crossing_speed_with_drag(point, radians(36.78), drag_of(cd)).value();
    EXPECT_GT(faster, slower);
    slower = faster;
  }
}

TEST(Drag, SaysWhenNothingFliesThere) {
  EXPECT_FALSE(crossing_speed_with_drag({0.5, 0.59}, radians(36.78), drag_of(0.25)));
  EXPECT_FALSE(crossing_speed_with_drag({100.0, 0.5}, radians(36.78), drag_of(0.5)));
  EXPECT_EQ(fly_with_drag(8.0, 0.0, 0.01).range_m, 0.0);
}

}  // namespace
}  // namespace trivela::kicking
