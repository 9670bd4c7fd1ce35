#pragma once

#include "kicking/policy/rule.hpp"

namespace trivela::kicking {

// The drives that calibrate a robot. Like the other policies they know nothing but their input and their memory, and
// reason kFire says: it would kick now, the common conditions aside. What they aim at is the target of the
// configuration; the kicks of the moving ones have the power that a standing robot's kick would need, by the robot's
// own table.

/// How far a drive has come. It outlives the possession.
struct DriveMemory : PossessionMemory {
  std::size_t level = 0;    ///< entry of the drive's list
  std::uint32_t kicks = 0;  ///< that count for this level; of the turn drive: for this step
  bool passing = false;     ///< on its way past the mark or the target; of this possession
  Twist command{};          ///< of the order: it goes on until the ball has left
  std::optional<std::int64_t> settling_since_t_ns;

  /// A pass or a rest that was interrupted starts over.
  void interrupt() override {
    passing = false;
    settling_since_t_ns.reset();
  }
  void order(const TestDriveConfig& config, const Twist& drive) override {
    passing = false;
    command = drive;
    if (++kicks < config.kicks_per_level) return;
    kicks = 0;
    ++level;
  }
  Twist pending_command() const override { return command; }
};

/// Of a bisection with each entry of the list.
struct TurnDriveMemory : DriveMemory {
  std::uint32_t step = 0;  ///< halvings done
  double low_rad = 0.0;    ///< the allowed error, as an angle, is between these
  std::optional<double> high_rad;
  double late_sum_m = 0.0;                          ///< of this step's balls, beyond the target in the sense of turning
  std::optional<std::uint32_t> awaited_possession;  ///< its kick has not been seen yet, and counts once it is

  void order(const TestDriveConfig&, const Twist& drive) override {
    passing = false;
    command = drive;
    awaited_possession = possession_id;
  }
};

/// For the laser (paper, section 2.1): stands where it was placed, waits until it is at rest for settle_s and kicks
/// with the next of `powers`, whatever the table says of it; but not while it faces away from the goal by more than 30
/// degrees.
PolicyOutput evaluate_standing_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                     const PolicyInput& input, DriveMemory& memory);

/// For alpha (section 3.2, figure 8): from a start mark beside the target's axis it passes sideways at a fixed
/// velocity, facing +y of F, and kicks as soon as it crosses the axis.
PolicyOutput evaluate_lateral_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                    const PolicyInput& input, DriveMemory& memory);

/// For the transfer of the forward velocity: the same along the axis, kicking at straight_distance_m from the target.
PolicyOutput evaluate_straight_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                     const PolicyInput& input, DriveMemory& memory);

/// For beta (section 3.3, figure 9): turns on the spot through the target at a fixed rate and kicks in the first cycle
/// in which its pointing line meets the target's segment. The side of the segment that it enters has the allowed error,
/// which a bisection adjusts until the balls cross at the target on average.
PolicyOutput evaluate_turn_drive(const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                                 const PolicyInput& input, TurnDriveMemory& memory);

}  // namespace trivela::kicking
