#pragma once

#include <string>

#include "calibration/drive_source.hpp"
#include "config/settings.hpp"

namespace trivela::calibration {

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
