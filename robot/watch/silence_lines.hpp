#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kicking/geometry/time.hpp"
#include "robot/watch/silence_watch.hpp"

namespace trivela::robot {

/// Sentences on silences: one where it begins and one where it ends. A stream that comes and goes makes no more than
/// two of them a second.
class SilenceLines {
 public:
  /// What is known of an edge, with the name that its stream goes by.
  void note(const SilenceEdge& edge, const std::string& name) {
    StreamState& state = streams_.try_emplace({edge.stream, edge.robot_id}, StreamState{.name = name}).first->second;
    if (!edge.to_ns) {
      state.silent_from_ns = edge.from_ns;
      return;
    }
    if (state.said) {
      ready_.push_back(fmt::format("{} back after {:.2f} s", name, kicking::seconds(*edge.to_ns - edge.from_ns)));
    } else if (state.silent_from_ns) {
      ++state.unsaid;
    }
    state.silent_from_ns.reset();
    state.said = false;
  }

  /// What is to be said now.
  std::vector<std::string> due(std::int64_t now_ns) {
    for (auto& [key, state] : streams_) {
      if (!state.silent_from_ns || state.said) continue;
      if (state.said_ns && now_ns - *state.said_ns < kPause_ns) continue;
      const std::string more =
          state.unsaid > 0 ? fmt::format(", and {} shorter silences before", state.unsaid) : std::string{};
      ready_.push_back(
          fmt::format("no {} for {:.2f} s{}", state.name, kicking::seconds(now_ns - *state.silent_from_ns), more));
      state.said = true;
      state.said_ns = now_ns;
      state.unsaid = 0;
    }
    return std::exchange(ready_, {});
  }

 private:
  struct StreamState {
    std::string name;
    std::optional<std::int64_t> silent_from_ns{};
    bool said = false;                      // that it is silent now
    std::optional<std::int64_t> said_ns{};  // when that was said last
    int unsaid = 0;                         // silences since then that nothing was said of
  };
  static constexpr std::int64_t kPause_ns = 1'000'000'000;

  std::map<std::pair<std::size_t, std::uint8_t>, StreamState> streams_;
  std::vector<std::string> ready_;
};

}  // namespace trivela::robot
