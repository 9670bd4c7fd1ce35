#pragma once

#include "bus/messages.hpp"
#include "sim/sensors.hpp"
#include "sim/truth.hpp"

namespace trivela::nodes {

/// The world's samples and truths as messages; robot_id and seq are the node's.
msg::SimWheels wheels_message(const sim::Sensors& sensors);
msg::SimKicker kicker_message(const sim::Sensors& sensors);
msg::VisionFrame vision_message(const sim::Sensors& sensors);
msg::FlightFrame flight_message(const sim::Sensors& sensors);
msg::Referee referee_message(const sim::Sensors& sensors);
msg::KickTruth truth_message(const sim::KickTruth& truth);
msg::PossessionTruth possession_message(const sim::PossessionTruth& truth);

}  // namespace trivela::nodes
