#include "experiment/calibration/calibration_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "calibration/calibration_run.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/estimate.hpp"
#include "kicking/fit/deflection_fit.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/policy/shot.hpp"
#include "sim/kicker/kicker.hpp"

namespace trivela::experiment {
namespace {
using kicking::degrees;

AimErrors errors(std::span<const log::Kick> kicks, const config::Settings& settings,
                 std::optional<log::RecordedOutcome> log::Kick::*crossing) {
  AimErrors result;
  std::vector<double> height_m, sideways_m;
  for (const log::Kick& kick : kicks) {
    if (!kick.accepted.value_or(false)) continue;
    ++result.kicks;
    const auto& seen = kick.*crossing;
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
  return errors(kicks, settings, &log::Kick::observed);
}

AimErrors true_errors(std::span<const log::Kick> kicks, const config::Settings& settings) {
  return errors(kicks, settings, &log::Kick::truth);
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
  const auto effective = [&](double transfer, double distance_m) {
    return transfer * world_effective_ratio(robot, world, settings, distance_m);
  };
  const kicking::TestDriveConfig& drive = settings.policy.test_drive;
  const kicking::Transfer& transfer = model.transfer_exact;
  const kicking::KickSpreads& spreads = model.spreads;  // what the robot must expect of its kicks
  const sim::Kicker& kicker = world.kicker;
  figures.insert(
      figures.end(),
      {{"exit_angle_deg", degrees(model.exit_angle_rad), degrees(angle_sum_rad / points)},
       {"delay_s", model.delay_s, kicker.delay_s},
       {"alpha_slope_deg_per_mps", degrees(model.alpha_slope_rad_per_mps),
        degrees(world_alpha_slope(robot, world, settings))},
       {"beta_slope_s", model.beta_slope_s, world_beta_slope(robot, world, settings)},
       {"transfer_forward_ratio", transfer.forward,
        effective(kicker.transfer_forward_ratio, drive.straight_distance_m)},
       {"transfer_backward_ratio", transfer.backward,
        effective(kicker.transfer_backward_ratio, drive.straight_distance_m)},
       {"transfer_lateral_ratio", transfer.lateral, effective(kicker.transfer_lateral_ratio, drive.distance_m)},
       {"speed_sd_ratio", spreads.speed_sd_ratio, kicker.speed_sd_ratio},
       {"direction_sd_deg", degrees(spreads.direction_sd_rad), degrees(kicker.direction_sd_rad)},
       {"delay_sd_s", spreads.delay_sd_s, kicker.delay_sd_s}});
  return figures;
}

namespace {
constexpr double kTwoSided95 = 1.959964;
constexpr std::uint32_t kPossessions = 20;

/// Standard error of a figure of against_world() in the figure's unit; none: the calibration gives none.
std::optional<double> se_of(const config::Robot& robot, const std::string& key) {
  const config::Calibration& c = robot.calibration.value();
  if (key.starts_with("exit_speed_")) {
    for (std::size_t i = 0; i < c.table->trials.size(); ++i) {
      const kicking::SetPoint& point = robot.model.table.set_points()[i];
      if (key != exit_speed_key(point.power)) continue;
      return point.speed_mps * robot.model.spreads.speed_sd_ratio / std::sqrt(c.table->trials[i]);
    }
  }
  if (key == "exit_angle_deg") return degrees(c.exit_angle->exit_angle_se_rad);
  if (key == "delay_s") return c.delay->delay_se_s;
  if (key == "alpha_slope_deg_per_mps") return degrees(c.deflection->alpha_slope_se_rad_per_mps);
  if (key == "beta_slope_s") return c.rotation->beta_slope_se_s;
  if (key == "transfer_forward_ratio") return c.transfer->exact_forward_se_ratio;
  if (key == "transfer_backward_ratio") return c.transfer->exact_backward_se_ratio;
  if (key == "transfer_lateral_ratio") return c.deflection->lateral_ratio_se;
  if (key == "direction_sd_deg" && c.direction) return degrees(c.direction->direction_sd_se_rad);
  return std::nullopt;
}

/// A calibration in which nothing scatters.
config::Robot noise_free_robot(SimulatedCalibrationOptions options) {
  sim::Scenario& world = options.scenario;
  sim::Kicker& kicker = world.kicker;
  kicker.delay_sd_s = kicker.speed_sd_ratio = kicker.direction_sd_rad = 0.0;
  sim::Odometry& odometry = world.odometry;
  odometry.wheel_sd_radps = odometry.slip_sd_ratio = odometry.gyro_sd_radps = odometry.gyro_bias_sd_radps = 0.0;
  sim::Vision& vision = world.vision;
  vision.position_white_sd_m = vision.position_slow_sd_m = vision.heading_white_sd_rad = vision.heading_slow_sd_rad =
      vision.ball_sd_m = vision.ball_sd_ratio = vision.dropout_ratio = 0.0;
  world.flight_camera.position_sd_m = world.flight_camera.dropout_ratio = 0.0;
  world.laser.range_sd_m = world.laser.dropout_ratio = world.laser.mixed_ratio = 0.0;
  return play_calibration(options).robot.robot();
}

}  // namespace

std::vector<StudiedFigure> study_figures(std::span<const SimulatedCalibration> calibrations,
                                         const SimulatedCalibrationOptions& options) {
  std::vector<StudiedFigure> figures;
  const config::Settings settings = calibration_settings(options.settings, options.scenario);
  const kicking::RobotModel noise_free = noise_free_robot(options).model;
  const std::map<std::string, double> by_procedure{
      {"alpha_slope_deg_per_mps", degrees(noise_free.alpha_slope_rad_per_mps)},
      {"beta_slope_s", noise_free.beta_slope_s}};
  for (const SimulatedCalibration& calibration : calibrations) {
    const config::Robot& robot = calibration.robot.robot();
    for (const WorldFigure& seen : against_world(robot, options.scenario, settings)) {
      const auto se = se_of(robot, seen.key);
      if (!se) continue;
      auto figure = std::ranges::find(figures, seen.key, &StudiedFigure::key);
      if (figure == figures.end()) {
        const auto procedure = by_procedure.find(seen.key);
        const double world = procedure == by_procedure.end() ? seen.world : procedure->second;
        figure = figures.insert(figure, StudiedFigure{.key = seen.key, .world = world});
      }
      const double off = seen.calibrated - figure->world;
      figure->mean += seen.calibrated;
      figure->rms += off * off;
      figure->mean_se += *se * *se;
      figure->covered += std::abs(off) <= kTwoSided95 * *se ? 1.0 : 0.0;
      ++figure->calibrations;
    }
  }
  for (StudiedFigure& figure : figures) {
    const auto n = static_cast<double>(figure.calibrations);
    figure.mean /= n;
    figure.rms = std::sqrt(figure.rms / n);
    figure.mean_se = std::sqrt(figure.mean_se / n);
    figure.covered /= n;
  }
  return figures;
}

std::vector<double> study_policy(std::span<const SimulatedCalibration> calibrations, const sim::Scenario& world,
                                 const config::Settings& settings, kicking::PolicyName policy, std::uint32_t matches,
                                 std::uint64_t seed, std::size_t jobs) {
  std::vector<double> rates(calibrations.size());
  in_threads(calibrations.size(), jobs, [&](std::size_t i) {
    Arm arm;
    arm.name = "studied";
    arm.policy = policy;
    arm.settings = settings;
    arm.settings.run.cycle_s = arm.settings.policy.cycle_s = world.cycle_s;
    arm.robots = {calibrations[i].robot.robot()};
    double on_target = 0.0;
    for (std::uint32_t match = 0; match < matches; ++match) {
      for (const auto& possession : play_match(world, arm, seed, match, kPossessions).possessions)
        on_target += possession.kick && possession.kick->truth == kicking::Outcome::kOnTarget ? 1.0 : 0.0;
    }
    rates[i] = on_target / (kPossessions * static_cast<double>(matches));
  });
  return rates;
}

}  // namespace trivela::experiment
