#pragma once

#include "idl/messages.hpp"
#include "kicking/lob/scan.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::hal {

/// The world's samples and truths as messages; robot_id and seq are the node's.
msg::DeviceWheels wheels_message(const sim::Sensors& sensors);
msg::DeviceKicker kicker_message(const sim::Sensors& sensors);
msg::VisionFrame vision_message(std::int64_t t_ns, const sim::VisionFrame& frame);
msg::FlightFrame flight_message(std::int64_t t_ns, const sim::FlightFrame& frame);
/// A set piece of ours is announced as the kick-off for a half's first possession, as a free kick for each further one.
msg::Referee referee_message(std::int64_t t_ns, const sim::RefereeState& word);
msg::SimScan scan_message(const kicking::lob::Scan& scan, const kicking::lob::ScanGeometry& geometry);
msg::KickTruth truth_message(const sim::KickTruth& truth);
msg::PossessionTruth possession_message(const sim::PossessionTruth& truth);

}  // namespace trivela::hal
