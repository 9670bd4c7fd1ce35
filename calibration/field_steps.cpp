#include "calibration/field_steps.hpp"

#include <fmt/format.h>

namespace trivela::calibration {
namespace {

using kicking::PolicyName;

std::string placing(const DrivePlan& plan, const config::Settings& settings) {
  const auto& drive = settings.policy.test_drive;
  const double ball_m = plan.ball_to_goal_m.value_or(0.0);
  switch (plan.policy) {
    case PolicyName::kStandingDrive:
      if (!plan.laser) {
        return fmt::format(
            "The lever moves: keep hands out of the kicker. Lay the ball {:.2f} m from the goal line and the robot\n"
            "behind it, facing the goal. Its kicks stay low. Put both back there after each kick.",
            ball_m);
      }
      return fmt::format(
          "Lay the ball {:.2f} m from the goal line, in the scanner's plane, and the robot behind it, facing the "
          "goal.\n"
          "Put both back there after each kick.",
          ball_m);
    case PolicyName::kLateralDrive:
      return fmt::format(
          "The robot passes sideways {:.2f} m from the goal line: keep some metres free to both sides of the goal's "
          "axis.\n"
          "Give it the ball there; it drives to its marks by itself.",
          drive.distance_m);
    case PolicyName::kTurnDrive:
      return fmt::format(
          "Put the robot {:.2f} m from the goal line, in front of the goal's middle, with the ball. It turns on the "
          "spot.",
          ball_m);
    case PolicyName::kStraightDrive:
      return fmt::format(
          "The robot drives at the goal and away from it and kicks {:.2f} m from the line: keep its axis free, {:.1f} "
          "m\n"
          "before and behind that place. Give it the ball there.",
          drive.straight_distance_m, drive.run_up_m);
    default:
      return "The check: give the robot the ball anywhere from 3 to 8 m from the goal line; it stops, aims and kicks.";
  }
}

}  // namespace

FieldMeasure standing_distance() { return {"standing_to_goal_m", "Standing kicks: ball to goal line, m", 2.0, 12.0}; }

FieldMeasure laser_ahead() {
  return {"laser_x_m", "Scanner from the ball, along the kick (negative: behind it), m", -5.0, 20.0};
}

FieldMeasure laser_height() { return {"laser_z_m", "Scanner over the floor, m", 0.0, 2.0}; }

std::string instructions(const DrivePlan& plan, const config::Settings& settings) {
  return fmt::format("{}\n{} kicks{}. After each: the ball back into the handler, everybody out of the way.\n",
                     placing(plan, settings), plan.possessions, plan.laser ? " over the scanner" : "");
}

}  // namespace trivela::calibration
