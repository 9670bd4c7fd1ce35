#pragma once

#include <cstdint>
#include <string>

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

}  // namespace trivela::robot
