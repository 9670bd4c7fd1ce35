#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/robot.hpp"
#include "kicking/fit/deflection_fit.hpp"
#include "kicking/fit/scatter_fit.hpp"
#include "kicking/fit/table_fit.hpp"
#include "kicking/fit/transfer_fit.hpp"
#include "kicking/learning/kicker_estimate.hpp"

namespace trivela::calibration {

/// How a table fit goes into the file.
struct TableChoice {
  kicking::TableKind kind = kicking::TableKind::kEffective;
  bool angle_per_set_point = false;  ///< the paper: one mean angle for all
};

/// A robot's file that a calibration brings up to date: the figures measured replace the old ones, all others stay, and
/// [calibration] says what was measured from what.
class RobotUpdate {
 public:
  /// `tool`: the verb as it was called, for the file's first line and [calibration]. `date`: ISO 8601.
  RobotUpdate(config::Robot robot, std::string tool, std::string date)
      : robot_(std::move(robot)), tool_(std::move(tool)), date_(std::move(date)) {}

  // Each replaces the figures of one fit, rounded to five decimals of the file's unit (errors to three digits); `files`
  // are the records and tables that it was made from.

  /// [table], kicker.exit_angle_deg and, where a set-point has several kicks, kicker.spreads of exit speed, exit angle
  /// and table. Throws std::invalid_argument for a table that does not rise, config::BadArgument for a true one where
  /// a measured effective one stands.
  void set_table(const kicking::TableFit& fit, const TableChoice& choice, const std::vector<std::string>& files);
  /// kicker.alpha_slope_deg_per_mps, and transfer_exact.lateral_ratio where the fit has it.
  void set_deflection(const kicking::DeflectionFit& fit, const std::vector<std::string>& files);
  /// kicker.beta_slope_s.
  void set_rotation(const kicking::RotationFit& fit, const std::vector<std::string>& files);
  /// transfer_exact and transfer_paper, forward and backward as far as the fit has them, and
  /// kicker.spreads.transfer_sd_ratio: root mean square of the standard errors of the exact law's.
  void set_transfer(const kicking::TransferFit& fit, const std::vector<std::string>& files);
  /// kicker.delay_s and kicker.spreads.delay_sd_s.
  void set_delay(const kicking::DelayFit& fit, const std::vector<std::string>& files);

  /// kicker.spreads.direction_sd_deg, which stays where the kicks do not show it.
  void set_direction(const kicking::DirectionFit& fit, std::size_t kicks, const std::vector<std::string>& files);

  /// Of a further kind of kick, model.kind(kind): its table, delay and spreads; its angle stays, and its transfer is
  /// that of the first kind. Throws std::invalid_argument for a table that does not rise.
  void set_kind(std::size_t kind, const kicking::TableFit& table, const kicking::DelayFit& delay,
                const kicking::DirectionFit& direction, const std::vector<std::string>& files);

  /// Table, angles, direction, delay, transfer, the lines of the paper and all spreads, as kicks in play show them.
  void set_play(const kicking::KickerEstimate& estimate, const std::vector<std::string>& files);

  const config::Robot& robot() const { return robot_; }

  /// A line a figure: key, old value, new value, standard error, kicks.
  const std::vector<std::string>& changes() const { return changes_; }

  /// The file: a comment that names the tool and what is measured, then the robot.
  std::string text() const;

  /// Writes it whole or not at all. Throws std::runtime_error naming the path, and the figure that a robot cannot
  /// have.
  void write(const std::filesystem::path& path) const;

 private:
  config::FigureOrigin origin(std::size_t kicks, const std::vector<std::string>& files) const;
  config::Calibration& calibration();
  void set_speeds(std::span<const kicking::SetPoint> points, kicking::TableKind kind);
  void set_transfer_spread();
  void unknown(const std::string& key, double before);
  void set_error(const std::string& key, double& before, const kicking::Estimate& mean, double daily, double unit,
                 std::size_t kicks);
  void changed(const std::string& key, double before, double after, const std::string& certainty);

  config::Robot robot_;
  std::string tool_;
  std::string date_;
  std::vector<std::string> changes_;
};

}  // namespace trivela::calibration
