#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

#include "idl/messages.hpp"

namespace trivela::pages {

/// The last sample of a topic and when it was heard.
template <class T>
struct Latest {
  std::optional<T> sample;
  std::int64_t received_ns = 0;

  void receive(const T& received, std::int64_t now_ns) {
    sample = received;
    received_ns = now_ns;
  }
  /// Where it is no older than `age_ns`.
  const T* within(std::int64_t age_ns, std::int64_t now_ns) const {
    return sample && now_ns - received_ns <= age_ns ? &*sample : nullptr;
  }
};

/// What was heard of a robot.
struct RobotView {
  Latest<msg::WorldState> world;
  Latest<msg::KickDecision> decision;
  Latest<msg::KickDecision> fired;  ///< the last one that did
  Latest<msg::KickerStatus> kicker;
  Latest<msg::DeviceKicker> device;
  Latest<msg::FlightFrame> flight;
  Latest<msg::KickerDrift> drift;
  Latest<msg::KickerEstimate> estimate;
  std::int64_t unarmed_since_ns = 0;  ///< the game is played and the kicker is off; 0: it is not so
};

/// What is kept of a robot as it came.
inline constexpr std::tuple kKeptOfRobots{&RobotView::world, &RobotView::kicker, &RobotView::flight, &RobotView::drift,
                                          &RobotView::estimate};

/// Whether it fires, and why or why not in words.
struct Why {
  bool fires = false;
  std::string words;
};

/// Older words say nothing of now.
inline constexpr std::int64_t kFresh_ns = 1'000'000'000;

/// The decision that fired, for a second, since an eye misses a cycle, or until it decides in another possession.
const msg::KickDecision* recent_fire(const RobotView& robot, std::int64_t now_ns);

/// Of its recent fire, else of its last decision, or where it decides nothing of what it believes.
Why why_of(const RobotView& robot, std::int64_t now_ns);

/// A reason as a part of a sentence: "the two segments do not meet".
const char* words_of(const msg::DecisionReason& reason);

}  // namespace trivela::pages
