#pragma once

#include "kicking/policy/policy.hpp"

namespace trivela::kicking {

// The drives that calibrate a robot. Like the other policies they know nothing but their input and their memory, and
// reason kFire says: it would kick now, the common conditions aside. What they aim at is the target of the
// configuration; the kicks of the moving ones have the power that a standing robot's kick would need, by the robot's
// own table.

/// For the laser (paper, section 2.1): stands where it was placed, waits until it is at rest for settle_s and kicks
/// with the next of `powers`, whatever the table says of it; but not while it faces away from the goal by more than 30
/// degrees.
Judgement judge_standing_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                               const PolicyInput& input, PolicyMemory& memory);

/// For alpha (section 3.2, figure 8): from a start mark beside the target's axis it passes sideways at a fixed
/// velocity, facing +y of F, and kicks as soon as it crosses the axis.
Judgement judge_lateral_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                              const PolicyInput& input, PolicyMemory& memory);

/// For the transfer of the forward velocity: the same along the axis, kicking at straight_distance_m from the target.
Judgement judge_straight_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                               const PolicyInput& input, PolicyMemory& memory);

/// For beta (section 3.3, figure 9): turns on the spot through the target at a fixed rate and kicks in the first cycle
/// in which its pointing line meets the target's segment. The side of the segment that it enters has the allowed error,
/// which a bisection adjusts until the balls cross at the target on average.
Judgement judge_turn_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                           const PolicyInput& input, PolicyMemory& memory);

/// Tells the drive's memory that its order goes out, with this command to the base.
void count_drive_kick(PolicyName drive, const PolicyConfig& config, const PolicyInput& input, const Twist& command,
                      TestDriveMemory& memory);

}  // namespace trivela::kicking
