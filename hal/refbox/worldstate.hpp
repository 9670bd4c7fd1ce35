#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "idl/robot.hpp"

namespace trivela::hal::refbox {

/// What the team says of itself beside its robots' beliefs.
struct TeamText {
  std::string name;
  std::string intention;  ///< in English, "attack"
};

/// What the league wants to hear from a team at 10 Hz: a JSON object of type "worldstate", one line without a NUL, by
/// RoboCup-MSL/RefBox, tools/JSON Worldstate Validator/MSLWMD-schema. Frame F: y to the opponents' goal, heading 0 =
/// +y, counter-clockwise; lengths in m, velocities in m/s over ground, turn rates in rad/s.
///
/// `ageMs` is the age at now_ns of the newest belief, 0 where there is none. A ball's confidence is 1 when it has just
/// been seen and falls by 1 a second. Nobody knows a height: null. What a robot does not know of itself (targetPose,
/// batteryLevel) is left out, as the schema allows; opponents are known by a distance alone, so `obstacles` is empty.
std::string worldstate_object(std::span<const msg::WorldState> robots, const TeamText& team, std::int64_t now_ns);

}  // namespace trivela::hal::refbox
