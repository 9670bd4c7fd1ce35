#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/testimony.hpp"
#include "tests/faults/troubled_board.hpp"

namespace trivela::faults {

/// What an order is made of, and whether anybody may fire it.
enum class OrderKind { kLawful, kStale, kWithoutBall, kOutOfRange, kUnauthorised };

struct Ordered {
  std::int64_t t_ns = 0;
  OrderKind kind = OrderKind::kLawful;
  int units = 0;  ///< of its pulse
};

/// What was said to a driver, what befell it, and what its board did. CLOCK_MONOTONIC.
struct KickerTimeline {
  std::map<std::int64_t, Ordered> ordered;   ///< by kick_id
  std::map<std::int64_t, bool> playing;      ///< from when on the game was on, or stood
  std::map<std::int64_t, Trouble> troubles;  ///< by their beginning
  std::vector<BoardPulse> pulses;
};

/// A judgement of the pulses.
struct JudgedPulses {
  std::vector<FireSeen> kicks;  ///< each with the order that it is of
  std::vector<std::string>
      complaints;  ///< of pulses without a lawful fresh order of their own, or while the game stood
};
JudgedPulses judge_pulses(const KickerTimeline& timeline);

/// Kicks that have no receipt in the log and stand in no gap that it counts: neither do the driver's counters rise by
/// them, nor is there a row of its silence around them, which is what a driver that was killed leaves.
std::vector<std::string> unlogged(const std::vector<FireSeen>& kicks, const std::filesystem::path& log);

}  // namespace trivela::faults
