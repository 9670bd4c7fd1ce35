#include "kicking/ballistics/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/vector_rows.hpp"

namespace trivela::kicking {
namespace {

/// By components: v_z = sqrt(2 g H), T = 2 v_z / g, v_x = D / T.
LobExit exit_from_components(double apex_m, double range_m, double gravity_mps2) {
  const double v_z = std::sqrt(2.0 * gravity_mps2 * apex_m);
  const double t_flight = 2.0 * v_z / gravity_mps2;
  const double v_x = range_m / t_flight;
  return {std::atan2(v_z, v_x), std::hypot(v_x, v_z), t_flight};
}

TEST(Lob, BothRoutesAgreeWithTheVectors) {
  for (const auto& row : tests::rows("calib_theta_v0.csv")) {
    SCOPED_TRACE(row.where());
    for (const auto route : {exit_from_lob, exit_from_components}) {
      const LobExit exit = route(row.number("H_m"), row.number("D_m"), kGravity_mps2);
      EXPECT_NEAR(exit.angle_rad, row.number("theta_rad"), 1e-6);
      EXPECT_NEAR(exit.speed_mps, row.number("v0_mps"), 1e-6);
      EXPECT_NEAR(exit.t_flight_s, row.number("flight_time_s"), 1e-6);
    }
  }
}

TEST(Lob, RefusesALobThatDoesNotFly) {
  EXPECT_THROW(exit_from_lob(0.0, 5.0), std::invalid_argument);
  EXPECT_THROW(exit_from_lob(1.0, -5.0), std::invalid_argument);
}

}  // namespace
}  // namespace trivela::kicking
