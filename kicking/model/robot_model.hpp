#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/ballistics/moving_kick.hpp"
#include "kicking/constants.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/model/power_table.hpp"

namespace trivela::kicking {

/// How much this robot's kicks differ from what its model says: standard deviations.
struct KickSpreads {
  double speed_sd_ratio = 0.03;             ///< exit speed, from kick to kick (assumed)
  double exit_angle_sd_rad = radians(0.5);  ///< elevation (assumed)
  double direction_sd_rad = radians(2.0);   ///< sideways (assumed)
  double delay_sd_s = 0.015;                ///< CAMBADA release 1.0: 50 ms mean, 80 ms max
  double table_sd_ratio = 0.01;             ///< of the calibrated exit speed itself (assumed)
  double transfer_sd_ratio = 0.1;           ///< of the calibrated transfer (assumed)
  // Of the file's own figures, where nobody measured them well: what is learned in play begins with them.
  double exit_angle_se_rad = 0.0;
  double direction_se_rad = 0.0;
  double delay_se_s = 0.0;
};

/// How many kinds of kick a robot may have, and what says that its lever is on the way from one to another.
inline constexpr std::size_t kMostKickKinds = 4;
inline constexpr std::uint8_t kLeverMoves = 255;

/// What a decision knows of its robot. The defaults are robot 1 of CAMBADA (release 1.0, config/kicker.map; laser
/// calibration).
struct RobotModel {
  /// Effective: apex height and range of lobs, drag-free.
  EffectiveTable table{{15, 5.97}, {20, 7.33},  {25, 8.39},  {30, 9.21},
                       {35, 9.82}, {40, 10.18}, {45, 10.44}, {50, 10.51}};
  /// Elevation of the kick over the floor (kicker.map): one for all powers, as the paper takes it.
  double exit_angle_rad = radians(36.78);
  /// Where they were calibrated apart: an angle for each power, which then holds instead.
  std::optional<AngleTable> exit_angles{};
  /// Of the kick from the robot's heading, left positive.
  double direction_rad = 0.0;
  /// For the paper's V_kick law: k of kicker.map forward; the released code halves it when the robot reverses; lateral
  /// is unused.
  Transfer transfer_paper{0.70, 0.35, 1.0};
  /// For the exact law and the predictor. Full forward and lateral transfer reproduces both k = 0.70 and Table 1;
  /// backward is assumed half, as the released code has it. None was measured apart.
  Transfer transfer_exact{1.0, 0.5, 1.0};
  /// From the order to the release of the ball. The released code says 50 ms on average, 80 ms at most; assumed in
  /// between.
  double delay_s = 0.06;
  /// Robot centre to ball centre, forward (released code).
  double ball_offset_m = 0.27;
  /// Slope of alpha over vx: least squares through the origin over Table 1 (8.617644 deg per m/s).
  double alpha_slope_rad_per_mps = radians(8.617644);
  /// Slope of beta over omega. Figure 10 has no published numbers: delay + ball offset / ball speed + half a cycle is
  /// about 0.11 s.
  double beta_slope_s = 0.12;
  Ball ball{};
  KickSpreads spreads{};
  /// Kinds of kick beside this one: other positions of a lever. Each is a whole model with a table, an angle, a delay
  /// and spreads of its own; ball and ball offset are the same.
  std::vector<RobotModel> further_kinds{};
  /// How long the lever takes from one kind to another: the 205 positions of the Falcons' ioBoard at 1.2 ms each.
  double lever_s = 0.25;

  std::size_t kinds() const { return 1 + further_kinds.size(); }
  /// Of kick kind `i`, below kinds().
  const RobotModel& kind(std::size_t i) const { return i == 0 ? *this : further_kinds[i - 1]; }

  /// Elevation of a kick of this power [rad].
  double exit_angle_at(double power) const { return exit_angles ? exit_angles->angle_for(power) : exit_angle_rad; }
};

}  // namespace trivela::kicking
