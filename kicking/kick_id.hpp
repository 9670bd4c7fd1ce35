#pragma once

#include <cstdint>

namespace trivela::kicking {

/// The number that is a kick's in every message and row: session (15 bit) | robot (8 bit) | counter (40 bit).
struct KickId {
  static constexpr std::uint32_t kLastSession = 0x7fff;

  std::uint32_t session = 0;
  std::uint8_t robot_id = 0;
  std::uint64_t counter = 0;  ///< of the robot's orders in this session, from 1

  constexpr std::int64_t number() const {
    return static_cast<std::int64_t>(std::uint64_t{session & kLastSession} << 48 | std::uint64_t{robot_id} << 40 |
                                     counter);
  }
  static constexpr KickId of(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    return {static_cast<std::uint32_t>(bits >> 48), static_cast<std::uint8_t>(bits >> 40 & 0xff),
            bits & ((std::uint64_t{1} << 40) - 1)};
  }
};

/// A session that may be one, 1 to 32767, out of any number.
constexpr std::uint32_t kick_session(std::uint64_t number) {
  return static_cast<std::uint32_t>(number % KickId::kLastSession) + 1;
}

/// The session of a decision node that starts at `unix_s`; `second`: of the robot's second one. Nodes of a robot that
/// start in different seconds have different ones, a first and a second too, if they start less than 4.5 hours apart
/// (16383 s): kicks of a match that a node was started again in stay apart, which sessions drawn at random do not
/// promise.
constexpr std::uint32_t kick_session_at(std::uint64_t unix_s, bool second) {
  return kick_session(2 * unix_s + (second ? 1 : 0));
}

}  // namespace trivela::kicking
