#include "experiment/calibration/calibration_study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiment/calibration/calibration_check.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::experiment {
namespace {

using kicking::degrees;

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
