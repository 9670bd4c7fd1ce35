#include "experiment/calibration/simulated_calibration.hpp"

#include <fmt/core.h>

#include <chrono>
#include <optional>
#include <utility>

#include "calibration/rows/lobs_of_scans.hpp"
#include "config/scenario/scenario.hpp"
#include "config/text/installation.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/lob/analyzer.hpp"
#include "kicking/optional_double.hpp"
#include "sim/kicker/kicker.hpp"
#include "sim/laser/laser.hpp"

namespace trivela::experiment {
namespace {

log::RecordedOutcome crossing_of(const auto& message) {
  return {std::string{bus::label(message.outcome)}, kicking::OptionalDouble{message.x_cross_m},
          kicking::OptionalDouble{message.z_cross_m}};
}

/// The last message of a kick.
template <class Message>
const Message* last_of(const std::vector<Message>& messages, std::int64_t kick_id) {
  const Message* last = nullptr;
  for (const Message& message : messages) {
    if (message.kick_id == kick_id) last = &message;
  }
  return last;
}

/// The scans of a match on their way to lobs.
class Laser {
 public:
  Laser(const sim::Scenario& scenario, const config::ScanRecorder& place)
      : analyzer_(sim::laser_model(scenario.laser).geometry,
                  {place.mount_x_m, place.mount_z_m, place.mount_front_elevation_rad, place.mount_mirrored}) {}

  void see(const std::vector<kicking::lob::Scan>& scans) {
    for (const kicking::lob::Scan& scan : scans) keep(analyzer_.add(scan));
  }

  std::vector<kicking::lob::LobRecord> lobs(const std::vector<log::TestedSetPoint>& set_points) {
    keep(analyzer_.finish());
    for (kicking::lob::LobRecord& lob : lobs_) calibration::annotate(lob, set_points, {});
    return std::move(lobs_);
  }

 private:
  void keep(std::optional<kicking::lob::LobRecord> lob) {
    if (lob) lobs_.push_back(std::move(*lob));
  }

  kicking::lob::Analyzer analyzer_;
  std::vector<kicking::lob::LobRecord> lobs_;
};

/// What the view `kicks` and drive_kicks.sql say of each decision that fired.
void add_kicks(const MatchRecord& match, calibration::DriveRecord& record) {
  for (std::size_t i = 0; i < match.orders.size(); ++i) {
    const msg::KickDecision& decision = match.decisions[i];
    const msg::KickReceipt& receipt = match.receipts[i];
    const msg::KickOutcome* const outcome = last_of(match.outcomes, decision.kick_id);
    const msg::KickTruth* const truth = last_of(match.kick_truths, decision.kick_id);
    log::Kick kick;
    kick.robot_id = decision.robot_id;
    kick.kick_id = decision.kick_id;
    kick.t_ns = decision.t_ns;
    kick.half = 1;
    kick.policy = std::string{msg::policy_name(decision)};
    kick.ordered = true;
    kick.accepted = receipt.accepted;
    if (outcome != nullptr) kick.observed = crossing_of(*outcome);
    if (truth != nullptr) kick.truth = crossing_of(*truth);
    record.kicks.push_back(kick);
    if (!receipt.accepted) continue;
    record.drives.kicks.push_back({.policy = kick.policy,
                                   .order_t_ns = receipt.order_t_ns,
                                   .pose = {decision.x_m, decision.y_m, decision.heading_rad},
                                   .twist = {decision.vx_mps, decision.vy_mps, decision.omega_radps},
                                   .goal_line_y_m = decision.target_y_m,
                                   .power = receipt.power,
                                   .x_cross_m = kick.observed ? kick.observed->x_cross_m : std::nullopt,
                                   .z_cross_m = kick.observed ? kick.observed->z_cross_m : std::nullopt,
                                   .robot = {0, decision.robot_id}});
  }
}

}  // namespace

sim::Scenario scenario_of(const calibration::DrivePlan& plan, sim::Scenario world) {
  world.laser.enabled = plan.laser;
  if (plan.ball_to_goal_m)
    world.possession.goal_distance_min_m = world.possession.goal_distance_max_m = *plan.ball_to_goal_m;
  return world;
}

calibration::DriveRecord DrivesInProcess::play(const calibration::DrivePlan& plan,
                                               const calibration::RobotUpdate& robot) {
  const auto begun = std::chrono::steady_clock::now();
  calibration::DriveRecord record;
  record.log = plan.name + ".db";
  const sim::Scenario scenario = scenario_of(plan, world_);
  std::optional<Laser> laser;
  if (plan.laser) {
    record.scans = plan.name + ".scans.db";
    laser.emplace(scenario, settings_.scan_recorder);
  }
  Arm arm;
  arm.name = plan.name;
  arm.policy = plan.policy;
  arm.settings = settings_;
  arm.robots = {robot.robot()};
  config::override_settings(arm.settings, plan.settings);
  PlayOptions options;
  auto& sightings = record.drives.sightings[{0, 1}];
  options.watch = [&](const sim::Sensors& sensors) {
    if (const auto& ball = sensors.flight.ball)
      sightings.push_back({sensors.flight.t_exposure_ns, {ball->x_m, ball->y_m, ball->z_m}});
    if (laser) laser->see(sensors.scans);
  };
  MatchRecord match;
  const PlayedMatch played =
      play_seeded_match(scenario, arm, static_cast<std::uint64_t>(plan.seed), plan.possessions, options, &match);
  add_kicks(match, record);
  std::vector<log::TestedSetPoint> set_points;
  for (const msg::KickReceipt& receipt : match.receipts) {
    if (!receipt.accepted) continue;
    set_points.push_back({receipt.fired_t_ns, receipt.power, receipt.kick_id});
    record.kicked_powers.push_back(receipt.power);
  }
  if (laser) record.lobs = laser->lobs(set_points);
  record.played_s = kicking::seconds(played.end_t_ns);
  record.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return record;
}

SimulatedCalibrationOptions default_simulated_calibration() {
  return {.scenario = config::load_scenario(config::shipped("scenarios/calibration.toml")),
          .settings = config::load_settings(config::shipped("default.toml")),
          .start = config::load_robot(config::shipped("robots/uncalibrated.toml"))};
}

void add_guessed_kinds(config::Robot& robot) {
  const config::Robot guess = config::load_robot(config::shipped("robots/lob_flat_1.toml"));
  robot.kinds = guess.kinds;
  robot.model.lever_s = guess.model.lever_s;
  robot.model.further_kinds = guess.model.further_kinds;
}

sim::Scenario calibration_scenario(const sim::Scenario& calibration, const sim::Scenario& world, std::uint32_t number) {
  sim::Scenario scenario = world;
  scenario.kicker = sim::team_kicker(world, number);
  scenario.kicker.drift_sd_ratio = 0.0;  // the day begins with it
  scenario.team = calibration.team;
  scenario.possession = calibration.possession;
  scenario.opponent = calibration.opponent;
  scenario.keeper = calibration.keeper;
  scenario.referee = calibration.referee;
  scenario.laser = calibration.laser;
  return scenario;
}

config::Settings calibration_settings(config::Settings settings) {
  settings.kick_decision.shadows = false;
  // The check aims at a height and stands for it, whatever the stopped policy plays by.
  kicking::PolicyConfig& policy = settings.policy;
  policy.height_law = kicking::HeightLaw::kExact;
  policy.aim_tolerance_rad = policy.test_drive.aim_tolerance_rad;
  policy.settle_s = policy.test_drive.settle_s;
  policy.rest_speed_mps = policy.test_drive.rest_speed_mps;
  policy.rest_turn_rate_radps = policy.test_drive.rest_turn_rate_radps;
  return settings;
}

config::Settings calibration_settings(config::Settings settings, const sim::Scenario& scenario) {
  settings = calibration_settings(std::move(settings));
  settings.run.cycle_s = settings.policy.cycle_s = scenario.cycle_s;
  const double ball_y_m = scenario.field.goal_line_y_m - scenario.possession.goal_distance_max_m;
  settings.scan_recorder.mount_x_m = scenario.laser.y_m - ball_y_m;
  settings.scan_recorder.mount_z_m = scenario.laser.z_m;
  settings.scan_recorder.mount_front_elevation_rad = scenario.laser.front_elevation_rad;
  return settings;
}

SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options, calibration::DriveSource& source,
                                      const std::function<void(const calibration::DriveSummary&)>& said) {
  config::Robot robot = options.start;
  robot.name = options.name;
  robot.source =
      fmt::format("simulated: trivela calibrate run --in simulation; what [calibration] does not name comes from: {}",
                  robot.source);
  robot.calibration.reset();
  const std::string command = fmt::format("trivela calibrate run --in simulation --robot {} --seed {}{}", options.name,
                                          options.seed, options.flags);
  calibration::CalibrationRun run{source,
                                  options.scenario.possession.goal_distance_max_m,
                                  calibration_settings(options.settings, options.scenario),
                                  options.effort,
                                  options.seed * 100,
                                  calibration::RobotUpdate{robot, command, options.date}};
  std::vector<calibration::DriveSummary> drives = run.calibration(said);
  return {run.robot(), std::move(drives)};
}

SimulatedCalibration play_calibration(const SimulatedCalibrationOptions& options) {
  DrivesInProcess source{options.scenario, calibration_settings(options.settings, options.scenario)};
  return play_calibration(options, source);
}

config::Robot calibrated_robot(const sim::Scenario& world, std::int64_t seed, std::uint32_t number) {
  SimulatedCalibrationOptions options = default_simulated_calibration();
  options.scenario = calibration_scenario(options.scenario, world, number);
  options.seed = seed;
  options.name = fmt::format("calibration_{}", seed);
  if (world.kicker.flat.enabled) add_guessed_kinds(options.start);
  return play_calibration(options).robot.robot();
}

std::vector<SimulatedCalibration> play_calibrations(const SimulatedCalibrationOptions& options, std::size_t count,
                                                    std::size_t jobs,
                                                    const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::optional<SimulatedCalibration>> calibrations(count);
  in_threads(
      count, jobs,
      [&](std::size_t i) {
        SimulatedCalibrationOptions of_one = options;
        of_one.seed += static_cast<std::int64_t>(i);
        of_one.name = fmt::format("{}_{}", options.name, of_one.seed);
        calibrations[i] = play_calibration(of_one);
      },
      progress);
  std::vector<SimulatedCalibration> played;
  played.reserve(count);
  for (std::optional<SimulatedCalibration>& calibration : calibrations) played.push_back(std::move(*calibration));
  return played;
}

}  // namespace trivela::experiment
