#pragma once

#include <cstdint>
#include <optional>

#include "idl/messages.hpp"

namespace trivela::robot {

/// The last word of one of the robot's topics, and when it came.
template <class T>
struct LatestSample {
  std::optional<T> word;
  std::int64_t received_ns = 0;  ///< steady clock; 0: never
};

/// What a robot's summary is made of.
struct TeamInputs {
  LatestSample<msg::WorldState> world;
  LatestSample<msg::KickerStatus> kicker;
  LatestSample<msg::KickDecision> decision;
  LatestSample<msg::Referee> referee;
  std::int64_t vision_received_ns = 0;
  std::int64_t drive_received_ns = 0;
};

/// A robot's summary: of what was heard within kAlarmSilence_ns; what was not is an alarm, and none in the summary.
msg::TeamSummary robot_summary(const TeamInputs& inputs, std::int64_t now_ns);

/// The base's, which has a referee and nothing else.
msg::TeamSummary base_summary(const LatestSample<msg::Referee>& referee, std::int64_t now_ns);

/// A mate's belief as a world_state of this machine's clock, for the node that tells the referee box; none: the mate
/// does not know where it is. What a summary does not have is none.
std::optional<msg::WorldState> world_of(const msg::TeamHeard& received);

}  // namespace trivela::robot
