#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// How many periods without a sample make a silence.
inline constexpr std::int64_t kSilentPeriods = 3;

/// The beginning or the end of a silence: a stream was heard and then not for more than three of its periods.
struct SilenceEdge {
  std::size_t stream = 0;
  std::uint8_t robot_id = 0;
  std::int64_t limit_ns = 0;            ///< three periods
  std::int64_t from_ns = 0;             ///< the last sample before it
  std::optional<std::int64_t> to_ns{};  ///< the first sample after it; none: it begins

  /// It ended, and by the samples' own instants nothing stayed away: they came late.
  bool was_delay() const { return to_ns && *to_ns >= from_ns && *to_ns - from_ns <= limit_ns; }
};

/// Knows which streams of which robots are silent. A stream that was never heard is not. Instants are nanoseconds of
/// one clock, the steady one in the nodes.
class SilenceWatch {
 public:
  /// `step_ns`: how far apart looks are meant to be. Where one comes later by far, it was this process that stood
  /// still: the time beyond two steps is nobody's silence.
  explicit SilenceWatch(std::int64_t step_ns) : step_ns_(step_ns), longest_step_ns_(2 * step_ns) {}

  /// One more stream; returns its number.
  std::size_t add(std::int64_t period_ns) {
    periods_ns_.push_back(period_ns);
    return periods_ns_.size() - 1;
  }

  /// A sample of `ns` was heard. A gap between the instants of two samples is a silence that has ended, even if no look
  /// saw it begin. The last sample once more, as a topic gives it to who joins late, is no news. `came_ns`: when it
  /// came, by the looks' clock; not known: when it was looked next.
  void received(std::size_t stream, std::uint8_t robot_id, std::int64_t ns, std::optional<std::int64_t> came_ns = {}) {
    const auto [place, first] = streams_.try_emplace({stream, robot_id});
    StreamState& state = place->second;
    if (!first && ns == state.last_ns) return;
    const std::int64_t limit_ns = kSilentPeriods * periods_ns_[stream];
    if (state.silent || (!first && ns > state.last_ns && ns - state.last_ns > limit_ns))
      edges_.push_back({stream, robot_id, limit_ns, state.last_ns, ns});
    state = {.last_ns = ns};
    if (came_ns) state.received_awake_ns = awake_ns_ + awake_since_look(*came_ns);
  }

  /// What began or ended since the last look, in the order in which it was noticed.
  std::vector<SilenceEdge> look(std::int64_t now_ns) {
    awake_ns_ += awake_since_look(now_ns);
    looked_ns_ = now_ns;
    for (auto& [key, state] : streams_) {
      const auto& [stream, robot_id] = key;
      const std::int64_t limit_ns = kSilentPeriods * periods_ns_[stream];
      if (!state.received_awake_ns) state.received_awake_ns = awake_ns_;
      if (state.silent || awake_ns_ - *state.received_awake_ns <= limit_ns) continue;
      state.silent = true;
      edges_.push_back({stream, robot_id, limit_ns, state.last_ns, std::nullopt});
    }
    return std::exchange(edges_, {});
  }

  /// For who does not look in equal steps, after look(): how long the next one may wait, until a stream could be silent
  /// that goes on now, no longer than `most_ns` and a step at least; a step while one is silent. What it comes later
  /// than that is nobody's silence.
  std::int64_t pause_ns(std::int64_t most_ns) {
    std::int64_t pause_ns = most_ns;
    for (const std::int64_t period_ns : periods_ns_) pause_ns = std::min(pause_ns, kSilentPeriods * period_ns);
    for (const auto& [key, state] : streams_) {
      const std::int64_t silent_ns = awake_ns_ - state.received_awake_ns.value_or(awake_ns_);
      pause_ns = state.silent ? 0 : std::min(pause_ns, kSilentPeriods * periods_ns_[key.first] - silent_ns);
    }
    return longest_step_ns_ = std::max(pause_ns, step_ns_);
  }

 private:
  std::int64_t awake_since_look(std::int64_t ns) const {
    return std::clamp<std::int64_t>(ns - looked_ns_.value_or(ns), 0, longest_step_ns_);
  }

  struct StreamState {
    std::int64_t last_ns = 0;
    std::optional<std::int64_t> received_awake_ns{};  // of the last sample, or of the first look after it
    bool silent = false;
  };

  std::int64_t step_ns_;
  std::int64_t longest_step_ns_;
  std::vector<std::int64_t> periods_ns_;
  std::map<std::pair<std::size_t, std::uint8_t>, StreamState> streams_;
  std::vector<SilenceEdge> edges_;
  std::int64_t awake_ns_ = 0;  // time that went on while somebody looked
  std::optional<std::int64_t> looked_ns_;
};

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
