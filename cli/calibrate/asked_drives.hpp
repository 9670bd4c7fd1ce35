#pragma once

#include "calibration/calibration_record.hpp"
#include "calibration/drive_source.hpp"
#include "calibration/field_steps.hpp"
#include "cli/launch/person.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// Somebody left for today: the same command goes on from here.
struct LeftForToday : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Asks for the length, proposing what is in the record, else `proposed`; keeps the answer. Throws LeftForToday.
double ask_for(const calibration::FieldMeasure& measure, double proposed, calibration::CalibrationRecord& kept,
               Person& person);

/// The drives of a calibration on a field: before each a person is told what to place and asked to go on, and each that
/// was played to its end is in the record. One that the record has is read from its records.
class AskedDrives : public calibration::DriveSource {
 public:
  /// All outlive it. `played_by`: plays what was confirmed.
  AskedDrives(calibration::DriveSource& played_by, const config::Settings& settings,
              calibration::CalibrationRecord& kept, Person& person)
      : played_by_(played_by), settings_(settings), kept_(kept), person_(person) {}

  /// Throws LeftForToday, and what the source throws; then the records so far are set aside when it is played again.
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override;

 private:
  calibration::DriveSource& played_by_;
  const config::Settings& settings_;
  calibration::CalibrationRecord& kept_;
  Person& person_;
};

}  // namespace trivela::cli
