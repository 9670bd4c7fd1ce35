#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "calibration/drive_source.hpp"
#include "config/settings.hpp"

namespace trivela::calibration {

/// What a calibration on a field has come to, in FOLDER/calibration.json, so that a second start goes on where the
/// first one ended. Every change is on the disk before it returns.
class CalibrationRecord {
 public:
  /// Goes on with the folder's record, or begins it. Throws config::BadArgument where it was begun with other
  /// `arguments`, naming both; std::runtime_error naming a record that cannot be written, or read,
  /// with the text that takes its place.
  CalibrationRecord(std::filesystem::path folder, std::string arguments);

  /// What a person has measured, by the name of what it is; none: not yet.
  std::optional<double> measured(const std::string& what) const;
  void measure(const std::string& what, double value);

  /// Whether the drive was played to its end: its records are whole.
  bool finished(const std::string& drive) const { return finished_.contains(drive); }
  void finish(const std::string& drive);

  const std::filesystem::path& folder() const { return folder_; }

 private:
  void read();
  void write() const;
  /// The record's text where those drives are finished.
  std::string text_with(const std::set<std::string>& finished) const;

  std::filesystem::path folder_;
  std::filesystem::path file_;
  std::string arguments_;
  std::map<std::string, double> measured_;
  std::set<std::string> finished_;
};

/// Puts the records of a drive that was not played to its end aside, each as DRIVE.partial-N.*, with the least N that
/// none has. Their number.
std::size_t set_aside(const std::filesystem::path& folder, const std::string& drive);

/// A length that a person measures on the field before the first drive.
struct FieldMeasure {
  std::string name;      ///< key in the calibration's record
  std::string question;  ///< for the person, without the proposed value
  double least_m;
  double most_m;
};

/// Where the ball lies for the standing kicks, to the goal line.
FieldMeasure standing_distance();
/// Scanner from the ball, along the kick; and over the floor.
FieldMeasure laser_ahead();
FieldMeasure laser_height();

/// What a person does before and during a drive, in sentences with its lengths and kicks.
std::string instructions(const DrivePlan& plan, const config::Settings& settings);

}  // namespace trivela::calibration
