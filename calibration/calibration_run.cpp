#include "calibration/calibration_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "calibration/rows/drive_rows.hpp"
#include "calibration/standing_lobs.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::calibration {
namespace {

using kicking::degrees;
using kicking::lob::LobRecord;

constexpr std::int64_t kSameKick_ns = 300'000'000;          // from the order to the launch that the laser saw, at most
constexpr double kLaserAngle_rad = kicking::radians(0.03);  // what all lobs of a scanner share: docs/calibration.md

std::vector<std::string> names(const std::vector<std::string>& files) {
  std::vector<std::string> out;
  out.reserve(files.size());
  for (const std::string& file : files) out.push_back(std::filesystem::path{file}.filename().string());
  return out;
}

std::string list_of(const std::vector<double>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(fmt::format("{:.17e}", value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// "8.62 +- 0.1 deg/(m/s)"
std::string figure(double value, double se, const char* unit) {
  return fmt::format("{:.4g} +- {:.2g} {}", value, se, unit);
}

}  // namespace

CalibrationRun::CalibrationRun(DriveSource& source, double standing_to_goal_m, const config::Settings& settings,
                               const CalibrationEffort& effort, std::int64_t seed, RobotUpdate update)
    : source_(source),
      standing_to_goal_m_(standing_to_goal_m),
      settings_(settings),
      effort_(effort),
      seed_(seed),
      update_(std::move(update)) {}

DriveRecord CalibrationRun::play(DriveSummary& summary, const std::string& name, kicking::PolicyName policy,
                                 double ball_to_goal_m, bool laser, std::size_t possessions,
                                 std::vector<std::string> settings) {
  const DrivePlan plan{.name = name,
                       .policy = policy,
                       .ball_to_goal_m = ball_to_goal_m,
                       .laser = laser,
                       .possessions = static_cast<std::uint32_t>(possessions),
                       .seed = seed_++,
                       .settings = std::move(settings)};
  DriveRecord record = source_.play(plan, update_);
  summary.logs.push_back(record.log);
  summary.played_s += record.played_s;
  summary.wall_s += record.wall_s;
  return record;
}

std::vector<kicking::TrackedTrial> CalibrationRun::followed() const {
  std::vector<double> delays_s;
  for (const DriveRecord& record : standing_) {
    const auto rows = release_delays(record.drives).rows;
    delays_s.insert(delays_s.end(), rows.begin(), rows.end());
  }
  kicking::RobotModel model = update_.robot().model;
  model.delay_s = kicking::fit_delay(delays_s).mean_s.value;
  std::vector<kicking::TrackedTrial> kicks;
  for (const DriveRecord& record : standing_) {
    for (const TrackedSpeed& kick : standing_kicks(record.drives, model).rows) {
      kicks.push_back({.power = kick.power, .up_mps = kick.up_mps, .sideways_rad = kick.sideways_rad});
      for (const LobRecord& lob : record.lobs) {
        if (is_trial(lob) && std::abs(lob.launch_t_ns - kick.order_t_ns) < kSameKick_ns)
          kicks.back().lob = kicking::Trial{.power = *lob.power,
                                            .exit_angle_rad = lob.effective->exit_angle_rad.value,
                                            .exit_speed_mps = lob.effective->exit_speed_mps.value};
      }
    }
  }
  return kicks;
}

void CalibrationRun::play_standing(DriveSummary& summary) {
  const std::vector<double>& powers = settings_.policy.test_drive.powers;
  NextRound round{powers, effort_.kicks};
  for (std::uint32_t i = 1; i <= effort_.rounds && !round.powers.empty(); ++i) {
    standing_.push_back(play(summary, i == 1 ? "1_standing" : fmt::format("1_standing_{}", i),
                             kicking::PolicyName::kStandingDrive, standing_to_goal_m_, true,
                             round.powers.size() * round.kicks,
                             {"policy.test_drive.powers = " + list_of(round.powers),
                              fmt::format("policy.test_drive.kicks_per_level = {}", round.kicks)}));
    summary.kicks += standing_.back().kicked_powers.size();
    round = next_round(tallies_of(powers, standing_), effort_.lobs);
  }
  require_lobs(tallies_of(powers, standing_), effort_.kicks);
}

DriveSummary CalibrationRun::standing() {
  DriveSummary summary;
  summary.name = "standing";
  play_standing(summary);
  std::vector<std::string> scans;
  for (const DriveRecord& record : standing_) {
    scans.push_back(record.scans);
    summary.used += static_cast<std::size_t>(std::ranges::count_if(record.lobs, is_trial));
  }
  summary.left_out = without_lob(standing_, summary.kicks);
  const kicking::TrackedTrials tracked = kicking::tracked_trials(followed());
  kicking::TableFit fit = fit_rising(tracked.trials, summary.left_out);
  fit.exit_angle_rad = tracked.exit_angle_rad;
  fit.exit_angle_rad.se = std::hypot(fit.exit_angle_rad.se, kLaserAngle_rad);
  if (!fit.shared_angle_warning.empty()) summary.left_out.push_back(fit.shared_angle_warning);
  summary.left_out.insert(summary.left_out.end(), fit.warnings.begin(), fit.warnings.end());
  update_.set_table(fit, {}, names(scans));
  summary.found = fmt::format("{} set-points, {:.2f} to {:.2f} m/s, exit angle {}", fit.set_points.size(),
                              fit.set_points.front().exit_speed_mps.mean, fit.set_points.back().exit_speed_mps.mean,
                              figure(degrees(fit.exit_angle_rad.value), degrees(fit.exit_angle_rad.se), "degrees"));
  return summary;
}

DriveSummary CalibrationRun::delay() {
  DriveSummary summary;
  summary.name = "delay";
  std::vector<double> delays_s;
  for (const DriveRecord& record : standing_) {
    summary.logs.push_back(record.log);
    summary.kicks += record.kicks.size();
    const auto kicks = release_delays(record.drives);
    delays_s.insert(delays_s.end(), kicks.rows.begin(), kicks.rows.end());
    summary.left_out.insert(summary.left_out.end(), kicks.left_out.begin(), kicks.left_out.end());
  }
  const kicking::DelayFit fit = kicking::fit_delay(delays_s);
  summary.used = delays_s.size() - fit.rejected.size();
  update_.set_delay(fit, names(summary.logs));
  summary.found = figure(1e3 * fit.mean_s.value, 1e3 * fit.mean_s.se, "ms");
  return summary;
}

DriveSummary CalibrationRun::direction() {
  DriveSummary summary;
  summary.name = "direction";
  std::vector<kicking::LaunchDirection> directions;
  for (const DriveRecord& record : standing_) {
    summary.logs.push_back(record.log);
    summary.kicks += record.kicks.size();
    const auto kicks = launch_directions(record.drives, update_.robot().model);
    directions.insert(directions.end(), kicks.rows.begin(), kicks.rows.end());
    summary.left_out.insert(summary.left_out.end(), kicks.left_out.begin(), kicks.left_out.end());
  }
  const kicking::DirectionFit fit = kicking::fit_direction(directions);
  summary.used = directions.size();
  update_.set_direction(fit, directions.size(), names(summary.logs));
  summary.found =
      fmt::format("sd {}; the camera's tracks have {:.2g} degrees",
                  figure(degrees(fit.sd_rad.value), degrees(fit.sd_rad.se), "degrees"), degrees(fit.observer_sd_rad));
  return summary;
}

DriveSummary CalibrationRun::lateral() {
  DriveSummary summary;
  summary.name = "lateral";
  const auto& drive = settings_.policy.test_drive;
  const DriveRecord record = play(summary, "3_lateral", kicking::PolicyName::kLateralDrive,
                                  drive.distance_m - update_.robot().model.ball_offset_m, false,
                                  drive.lateral_mps.size() * effort_.drive_kicks,
                                  {fmt::format("policy.test_drive.kicks_per_level = {}", effort_.drive_kicks)});
  summary.kicks = record.kicks.size();
  const auto kicks = lateral_kicks(record.drives, update_.robot().model);
  summary.left_out = kicks.left_out;
  summary.used = kicks.rows.size();
  const kicking::DeflectionFit fit = kicking::fit_deflection(kicks.rows, update_.robot().model.delay_s);
  update_.set_deflection(fit, names(summary.logs));
  lateral_ = transfer_kicks(record.drives, update_.robot().model).rows;
  summary.found = "alpha " + figure(degrees(fit.line.slope.value), degrees(fit.line.slope.se), "degrees per m/s");
  return summary;
}

DriveSummary CalibrationRun::turn() {
  DriveSummary summary;
  summary.name = "turn";
  const auto& drive = settings_.policy.test_drive;
  const std::size_t kicks_wanted = drive.turn_radps.size() * drive.turn_steps * effort_.turn_kicks;
  // A kick that was not seen to cross is repeated: some more possessions.
  const DriveRecord record =
      play(summary, "4_turn", kicking::PolicyName::kTurnDrive, kTurnDistance_m - update_.robot().model.ball_offset_m,
           false, kicks_wanted + 2, {fmt::format("policy.test_drive.turn_kicks_per_step = {}", effort_.turn_kicks)});
  summary.kicks = record.kicks.size();
  const auto kicks = turn_kicks(record.drives, update_.robot().model, settings_.run.cycle_s);
  summary.left_out = kicks.left_out;
  summary.used = kicks.rows.size();
  const kicking::RotationFit fit = kicking::fit_rotation(
      kicks.rows, kicking::RotationLever{update_.robot().model.ball_offset_m, settings_.run.cycle_s});
  update_.set_rotation(fit, names(summary.logs));
  summary.found = "beta " + figure(fit.line.slope.value, fit.line.slope.se, "s");
  return summary;
}

DriveSummary CalibrationRun::straight() {
  DriveSummary summary;
  summary.name = "straight";
  const auto& drive = settings_.policy.test_drive;
  const DriveRecord record = play(summary, "5_straight", kicking::PolicyName::kStraightDrive,
                                  drive.straight_distance_m - update_.robot().model.ball_offset_m, false,
                                  drive.straight_mps.size() * effort_.drive_kicks,
                                  {fmt::format("policy.test_drive.kicks_per_level = {}", effort_.drive_kicks)});
  summary.kicks = record.kicks.size();
  const auto& model = update_.robot().model;
  std::vector<kicking::TransferRow> rows =
      lateral_;  // at rest along the pointing line: what the others are held against
  const auto kicks = transfer_kicks(record.drives, model);
  rows.insert(rows.end(), kicks.rows.begin(), kicks.rows.end());
  summary.left_out = kicks.left_out;
  summary.used = kicks.rows.size();
  const kicking::TransferFit fit = kicking::fit_transfer(rows, model.delay_s, model.ball.radius_m);
  update_.set_transfer(fit, names(summary.logs));
  const auto share = [](const std::optional<kicking::TransferDirection>& direction) {
    return direction ? figure(direction->exact.value, direction->exact.se, "") : std::string{"not measured"};
  };
  summary.found = fmt::format("transfer forward {}, backward {}", share(fit.forward), share(fit.backward));
  summary.left_out.insert(summary.left_out.end(), fit.failed.begin(), fit.failed.end());
  return summary;
}

DriveSummary CalibrationRun::low_kind(std::size_t kind) {
  DriveSummary summary;
  summary.name = update_.robot().kinds.at(kind - 1).name;
  std::vector<double> powers;
  for (const kicking::SetPoint& point : update_.robot().model.kind(kind).table.set_points())
    powers.push_back(point.power);
  const DriveRecord record =
      play(summary, fmt::format("{}_{}", 5 + kind, summary.name), kicking::PolicyName::kStandingDrive,
           standing_to_goal_m_, false, powers.size() * effort_.kind_kicks,
           {fmt::format("policy.test_drive.kick_kind = {}", kind), "policy.test_drive.powers = " + list_of(powers),
            fmt::format("policy.test_drive.kicks_per_level = {}", effort_.kind_kicks)});
  summary.kicks = record.kicks.size();
  kicking::RobotModel model = update_.robot().model.kind(kind);
  const auto delays = release_delays(record.drives);
  if (delays.rows.size() < 2) {
    throw std::runtime_error{
        fmt::format("kind of kick \"{}\": the goal camera saw {} of {} kicks leave, 2 are needed at least",
                    summary.name, delays.rows.size(), summary.kicks)};
  }
  const kicking::DelayFit delay = kicking::fit_delay(delays.rows);
  model.delay_s = delay.mean_s.value;
  const auto kicks = low_kicks(record.drives, model);
  summary.left_out = kicks.left_out;
  summary.used = kicks.rows.size();
  const kicking::TableFit table = fit_rising(kicks.rows, summary.left_out);
  const kicking::DirectionFit direction = kicking::fit_direction(launch_directions(record.drives, model).rows);
  update_.set_kind(kind, table, delay, direction, names(summary.logs));
  summary.found = fmt::format("{} set-points, {:.2f} to {:.2f} m/s, delay {}", table.set_points.size(),
                              table.set_points.front().exit_speed_mps.mean, table.set_points.back().exit_speed_mps.mean,
                              figure(1e3 * delay.mean_s.value, 1e3 * delay.mean_s.se, "ms"));
  return summary;
}

std::vector<DriveSummary> CalibrationRun::calibration(const std::function<void(const DriveSummary&)>& said) {
  std::vector<DriveSummary> drives;
  for (const auto step : {&CalibrationRun::standing, &CalibrationRun::delay, &CalibrationRun::direction,
                          &CalibrationRun::lateral, &CalibrationRun::turn, &CalibrationRun::straight}) {
    drives.push_back((this->*step)());
    if (said) said(drives.back());
  }
  for (std::size_t kind = 1; kind < update_.robot().model.kinds(); ++kind) {
    drives.push_back(low_kind(kind));
    if (said) said(drives.back());
  }
  return drives;
}

}  // namespace trivela::calibration
