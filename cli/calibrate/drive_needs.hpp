#pragma once

#include "bus/domain/participant.hpp"
#include "calibration/drive_source.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// What a drive on a robot needs of others: `vision`, `flight_camera`, a bridge where wheels or kicker stand behind
/// one, over the scanner a device for it. Throws std::runtime_error naming the drive and everything that lacks, after
/// two seconds in which nobody came.
void require_for_drive(const bus::Participant& participant, const config::Settings& settings,
                       const calibration::DrivePlan& plan);

}  // namespace trivela::cli
