#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "idl/messages.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// What the referee's word permits.
enum class RefereeSays {
  kNothing,  ///< he has not spoken yet
  kStop,
  kPlay,
  kSilent  ///< his last word was to play, but it is too old or nobody writes it any more: as good as kStop
};

/// Whether the referee's last word still counts: "play" does until timeout_s after the word's own t_ns, on the steady
/// clock, and while somebody is there to take it back. heard() and says() are for one thread at a time, writers() for
/// any.
class RefereeWatch {
 public:
  explicit RefereeWatch(double timeout_s) : timeout_s_(timeout_s) {}

  /// A word from the future is as good as one of now.
  void heard(const msg::Referee& word, std::int64_t now_ns) {
    word_ = Word{std::min(word.t_ns, now_ns), word.playing};
    deserted_ = false;
  }

  /// To be told of each change among his writers: how many live.
  void writers(std::uint32_t alive) {
    if (alive == 0) deserted_ = true;
  }

  RefereeSays says(std::int64_t now_ns) const {
    if (!word_) return RefereeSays::kNothing;
    if (!word_->playing) return RefereeSays::kStop;
    return deserted_ || age_s(now_ns) > timeout_s_ ? RefereeSays::kSilent : RefereeSays::kPlay;
  }

  /// When the last word, which is to play, ends to count. 0: there is none.
  std::int64_t counts_until_ns() const { return word_ ? word_->t_ns + kicking::nanoseconds(timeout_s_) : 0; }

  /// A sentence whenever he falls silent or is heard again; none in between.
  std::optional<std::string> news(std::int64_t now_ns) {
    const bool silent = says(now_ns) == RefereeSays::kSilent;
    if (silent == silent_) return std::nullopt;
    silent_ = silent;
    if (!silent) return "the referee is heard again";
    return fmt::format("the referee is silent, his last word is of {:.2f} s ago: the game counts as stopped",
                       age_s(now_ns));
  }

 private:
  double age_s(std::int64_t now_ns) const { return kicking::seconds(now_ns - word_->t_ns); }

  struct Word {
    std::int64_t t_ns;
    bool playing;
  };
  double timeout_s_;
  std::optional<Word> word_;
  std::atomic<bool> deserted_ = false;
  bool silent_ = false;
};

}  // namespace trivela::robot
