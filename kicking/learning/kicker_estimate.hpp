#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "kicking/geometry/angle.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::kicking {

/// In what a kicker differs from its robot's file. Each is added to the file's figure; the speed as a logarithm.
enum KickerPart : Eigen::Index {
  kSpeedPart,      ///< ln of the exit speed by that of the table
  kElevationPart,  ///< exit angle [rad]
  kDirectionPart,  ///< of the kick from the robot's heading, left positive [rad]
  kDelayPart,      ///< from order to release [s]
  kAlongPart,      ///< share of the robot's velocity that the ball takes along, forward and backward
  kSidewaysPart,   ///< the same sideways
  kKickerParts
};
using KickerVector = Eigen::Matrix<double, kKickerParts, 1>;
using KickerMatrix = Eigen::Matrix<double, kKickerParts, kKickerParts>;

/// How much a kicker changes from one day to another, and by a jump within a match: standard deviations. All assumed.
struct KickerChange {
  double speed_sd_ratio = 0.05;
  double elevation_sd_rad = radians(1.0);
  double direction_sd_rad = radians(1.0);
  double delay_sd_s = 0.02;
  double transfer_sd_ratio = 0.1;
  double jump_chance = 0.01;  ///< that it changes so much from one kick to the next
};

/// What the kicks seen so far say of a kicker.
struct KickerEstimate {
  KickerVector mean = KickerVector::Zero();
  KickerVector se = KickerVector::Zero();  ///< standard errors
  double speed_sd_ratio = 0.0;             ///< from kick to kick: standard deviations
  double elevation_sd_rad = 0.0;
  double direction_sd_rad = 0.0;
  double delay_sd_s = 0.0;
  std::uint32_t kicks = 0;  ///< that it has learned from
  double p_mistaken = 0.0;  ///< probability that the sightings of the last kick say nothing of the kicker
  double p_jump = 0.0;      ///< probability that the kicker changed at the last kick
  /// Of the last flight's four residuals against what was believed before it; 4 on average where all of this is right.
  double chi_square = 0.0;
};

/// No difference or error is beyond 2 of its unit (e^2 of the speed, 2 rad, 2 s), no error below 0, all are finite:
/// what came over a bus or out of a file may be used.
bool valid(const KickerEstimate& estimate);

/// The robot as the estimate has it. The means are added to table, angles, direction, delay and transfer; the lines of
/// the paper follow. The spreads hold the standard errors, so that every probability allows for them. Every figure
/// stays in the range that a robot's file may have.
///
///     alpha_slope' = alpha_slope e^-s + side / (V c),   beta_slope' = beta_slope + delay + side r / (V c)
///
/// with s the logarithm of the speed, V and c the speed and cosine in the middle of the table, r the ball's offset. Of
/// further kinds of kick speed, delay and transfer are corrected alike, and nothing else.
RobotModel corrected(const RobotModel& file, const KickerEstimate& estimate);

}  // namespace trivela::kicking
