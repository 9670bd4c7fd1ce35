#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "idl/messages.hpp"

namespace trivela::robot {

/// Bits of TeamSummary::alarms. Silent: nothing came for kAlarmSilence_ns.
enum class Alarm : std::uint32_t {
  kWorldSilent = 1u << 0,     ///< no world_state
  kVisionSilent = 1u << 1,    ///< no vision
  kDecisionSilent = 1u << 2,  ///< no drive: kick_decision says nothing
  kKickerSilent = 1u << 3,    ///< no kicker_status
  kKickerFault = 1u << 4,     ///< it reports one
  kRefereeSilent = 1u << 5,   ///< no referee: the robot stands, the base has no word to pass on
};

constexpr std::uint32_t bit(Alarm alarm) { return static_cast<std::uint32_t>(alarm); }

inline constexpr std::int64_t kAlarmSilence_ns = 1'000'000'000;

/// "world_state silent, kicker fault"; empty: none. Bits that a newer version has are told by their number.
std::string alarm_words(std::uint32_t alarms);

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
