#include "experiment/calibration/calibration_check.hpp"

#include <fmt/core.h>

#include <cmath>

#include "calibration/calibration_run.hpp"
#include "kicking/estimate.hpp"
#include "kicking/fit/deflection_fit.hpp"
#include "kicking/fit/rotation_fit.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/policy/shot.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::experiment {
namespace {

using kicking::degrees;
using log::RecordedOutcome;

AimErrors errors(std::span<const log::Kick> kicks, const config::Settings& settings, auto&& crossing_of) {
  AimErrors result;
  std::vector<double> height_m, sideways_m;
  for (const log::Kick& kick : kicks) {
    if (!kick.accepted.value_or(false)) continue;
    ++result.kicks;
    const std::optional<RecordedOutcome>& seen = crossing_of(kick);
    const bool crossed = seen && seen->x_cross_m && seen->z_cross_m;
    if (!crossed) ++result.without_crossing;
    height_m.push_back(crossed ? std::abs(*seen->z_cross_m - settings.policy.target_height_m) : HUGE_VAL);
    sideways_m.push_back(crossed ? std::abs(*seen->x_cross_m - settings.policy.target_x_m) : HUGE_VAL);
  }
  if (result.kicks == 0) return {.median_height_m = std::nan(""), .median_sideways_m = std::nan("")};
  result.median_height_m = kicking::median(height_m);
  result.median_sideways_m = kicking::median(sideways_m);
  return result;
}

/// How the world's kicker sends a standing robot's ball, `distance_m` from the target.
sim::Exit world_exit(const config::Robot& robot, const sim::Scenario& world, const config::Settings& settings,
                     double distance_m) {
  kicking::PolicyInput input;
  input.pose = {settings.policy.target_x_m, settings.goal.y_m - distance_m, 0.0};
  const auto shot = kicking::stopped_shot(settings.policy, robot.model, settings.goal, input,
                                          kicking::target_on_line(settings.policy, settings.goal));
  sim::Exit exit = sim::exit_at(world.kicker, shot.power.value_or(robot.model.table.front().power));
  exit.speed_mps *= world.kicker.speed_scale_ratio;
  return exit;
}

double horizontal_mps(const sim::Exit& exit) { return exit.speed_mps * std::cos(exit.elevation_rad); }

double world_v_h_mps(const config::Robot& robot, const sim::Scenario& world, const config::Settings& settings,
                     double distance_m) {
  return horizontal_mps(world_exit(robot, world, settings, distance_m));
}

/// Effective over true horizontal speed: in the drag-free law the robot's own speed is smaller by it, too.
double world_effective_ratio(const config::Robot& robot, const sim::Scenario& world, const config::Settings& settings,
                             double distance_m) {
  const sim::Exit exit = world_exit(robot, world, settings, distance_m);
  return horizontal_mps(sim::effective_exit(exit, world.ball)) / horizontal_mps(exit);
}

double world_alpha_slope(const config::Robot& robot, const sim::Scenario& world, const config::Settings& settings) {
  const double lever_m = world.robot.ball_offset_m;
  const double distance_m = settings.policy.test_drive.distance_m - lever_m;
  const double v_h_mps = world_v_h_mps(robot, world, settings, settings.policy.test_drive.distance_m);
  std::vector<kicking::DeflectionRow> rows;
  for (const double vx_mps : settings.policy.test_drive.lateral_mps) {
    const double b_m = vx_mps * (world.kicker.delay_s + world.kicker.transfer_lateral_ratio * distance_m / v_h_mps);
    rows.push_back({.vx_mps = vx_mps, .distance_m = distance_m, .b_m = b_m, .lever_m = lever_m});
  }
  return kicking::fit_deflection(rows).line.slope.value;
}

double world_beta_slope(const config::Robot& robot, const sim::Scenario& world, const config::Settings& settings) {
  const double v_h_mps = world_v_h_mps(robot, world, settings, calibration::kTurnDistance_m);
  std::vector<kicking::RotationRow> rows;
  for (const double omega_radps : settings.policy.test_drive.turn_radps) {
    // An order goes out half a cycle late on average.
    const double point_mps = world.kicker.transfer_lateral_ratio * std::abs(omega_radps) * world.robot.ball_offset_m;
    const double beta_rad =
        std::abs(omega_radps) * (world.kicker.delay_s + 0.5 * world.cycle_s) + std::atan(point_mps / v_h_mps);
    rows.push_back({.omega_radps = omega_radps,
                    .allowed_error_m = calibration::kTurnDistance_m * std::tan(beta_rad),
                    .distance_m = calibration::kTurnDistance_m});
  }
  return kicking::fit_rotation(rows).line.slope.value;
}

}  // namespace

std::string exit_speed_key(double power) { return fmt::format("exit_speed_{:g}_mps", power); }

AimErrors observed_errors(std::span<const log::Kick> kicks, const config::Settings& settings) {
  return errors(
      kicks, settings, [](const log::Kick& kick) -> const auto& { return kick.observed; });
}

AimErrors true_errors(std::span<const log::Kick> kicks, const config::Settings& settings) {
  return errors(
      kicks, settings, [](const log::Kick& kick) -> const auto& { return kick.truth; });
}

std::vector<WorldFigure> against_world(const config::Robot& robot, const sim::Scenario& world,
                                       const config::Settings& settings) {
  const kicking::RobotModel& model = robot.model;
  std::vector<WorldFigure> figures;
  double angle_sum_rad = 0.0;
  for (const kicking::SetPoint& point : model.table.set_points()) {
    sim::Exit exit = sim::exit_at(world.kicker, point.power);
    exit.speed_mps *= world.kicker.speed_scale_ratio;
    const sim::Exit effective = sim::effective_exit(exit, world.ball);
    angle_sum_rad += effective.elevation_rad;
    figures.push_back({exit_speed_key(point.power), point.speed_mps, effective.speed_mps});
  }
  const auto points = static_cast<double>(model.table.set_points().size());
  figures.push_back({"exit_angle_deg", degrees(model.exit_angle_rad), degrees(angle_sum_rad / points)});
  figures.push_back({"delay_s", model.delay_s, world.kicker.delay_s});
  figures.push_back({"alpha_slope_deg_per_mps", degrees(model.alpha_slope_rad_per_mps),
                     degrees(world_alpha_slope(robot, world, settings))});
  figures.push_back({"beta_slope_s", model.beta_slope_s, world_beta_slope(robot, world, settings)});
  const auto effective = [&](double transfer, double distance_m) {
    return transfer * world_effective_ratio(robot, world, settings, distance_m);
  };
  const kicking::TestDriveConfig& drive = settings.policy.test_drive;
  figures.push_back({"transfer_forward_ratio", model.transfer_exact.forward,
                     effective(world.kicker.transfer_forward_ratio, drive.straight_distance_m)});
  figures.push_back({"transfer_backward_ratio", model.transfer_exact.backward,
                     effective(world.kicker.transfer_backward_ratio, drive.straight_distance_m)});
  figures.push_back({"transfer_lateral_ratio", model.transfer_exact.lateral,
                     effective(world.kicker.transfer_lateral_ratio, drive.distance_m)});
  // What the robot must expect of its kicks, beside what the world draws.
  const kicking::KickSpreads& spreads = model.spreads;
  figures.push_back({"speed_sd_ratio", spreads.speed_sd_ratio, world.kicker.speed_sd_ratio});
  figures.push_back({"direction_sd_deg", degrees(spreads.direction_sd_rad), degrees(world.kicker.direction_sd_rad)});
  figures.push_back({"delay_sd_s", spreads.delay_sd_s, world.kicker.delay_sd_s});
  return figures;
}

}  // namespace trivela::experiment
