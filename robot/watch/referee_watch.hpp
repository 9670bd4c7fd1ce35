#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {

/// What the referee's command permits.
enum class RefereePermission {
  kNothing,  ///< it has said nothing yet
  kStop,
  kPlay,
  kSilent  ///< its last command was to play, but is too old or has no writer any more: counts as kStop
};

/// Whether the referee's last command still counts. "Play" does until timeout_s after the command's own t_ns, on the
/// steady clock, and while any writer is there to take it back. One program is to write commands. Where several do, the
/// stricter one counts: "stop" of any that came within timeout_s. received() and says() are for one thread at a time,
/// writers() for any.
class RefereeWatch {
 public:
  explicit RefereeWatch(double timeout_s) : timeout_s_(timeout_s) {}

  /// A command from the future counts as one of now. `writer` tells the programs that write apart.
  void received(const msg::Referee& command, std::int64_t now_ns, std::uint64_t writer = 0) {
    std::erase_if(others_, [&](const Other& other) { return other.writer == writer || is_old(other, now_ns); });
    if (last_ && writer != writer_ && others_.size() < kMostOthers) others_.push_back({writer_, received_ns_, *last_});
    received_ns_ = now_ns;
    last_ = Command{std::min(command.t_ns, now_ns), command.playing};
    writer_ = writer;
    deserted_ = false;
  }

  /// Is called at each change among the writers: how many live.
  void writers(std::uint32_t alive) {
    if (alive == 0) deserted_ = true;
  }

  RefereePermission says(std::int64_t now_ns) const {
    if (!last_) return RefereePermission::kNothing;
    if (!last_->playing || other_stops(now_ns)) return RefereePermission::kStop;
    return deserted_ || age_s(now_ns) > timeout_s_ ? RefereePermission::kSilent : RefereePermission::kPlay;
  }

  /// When the last command, which is to play, ceases to count. 0: there is none.
  std::int64_t counts_until_ns() const { return last_ ? last_->t_ns + kicking::nanoseconds(timeout_s_) : 0; }

  /// A sentence whenever it falls silent or comes again, or a second program begins to write; none in between.
  std::optional<std::string> news(std::int64_t now_ns) {
    const bool contested = std::ranges::any_of(others_, [&](const Other& other) { return !is_old(other, now_ns); });
    if (std::exchange(contested_, contested) != contested)
      return contested ? "several programs write referee for this robot: the stricter command counts; stop all but one"
                       : "one program writes referee again";
    const bool silent = says(now_ns) == RefereePermission::kSilent;
    if (silent == silent_) return std::nullopt;
    silent_ = silent;
    if (!silent) return "the referee is received again";
    return fmt::format("the referee is silent, its last command is of {:.2f} s ago: the game counts as stopped",
                       age_s(now_ns));
  }

 private:
  struct Command {
    std::int64_t t_ns;
    bool playing;
  };
  struct Other {
    std::uint64_t writer;
    std::int64_t received_ns;
    Command command;
  };
  static constexpr std::size_t kMostOthers = 8;

  double age_s(std::int64_t now_ns) const { return kicking::seconds(now_ns - last_->t_ns); }
  bool is_old(const Other& other, std::int64_t now_ns) const {
    return kicking::seconds(now_ns - other.received_ns) > timeout_s_;
  }
  bool other_stops(std::int64_t now_ns) const {
    return std::ranges::any_of(others_,
                               [&](const Other& other) { return !other.command.playing && !is_old(other, now_ns); });
  }

  double timeout_s_;
  std::optional<Command> last_;
  std::uint64_t writer_ = 0;      // of last_
  std::int64_t received_ns_ = 0;  // last_
  std::vector<Other> others_;     // last commands of other writers
  std::atomic<bool> deserted_ = false;
  bool silent_ = false;
  bool contested_ = false;
};

}  // namespace trivela::robot
