#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace trivela::log {

/// How long rows may wait for company before their commit begins, so that none is older than the span once it is safe:
/// the span, less a tenth for the bus and the scheduler, less what the slowest of the recent commits took, at least a
/// quarter, since any disk is slow now and then. A row that comes as a commit begins waits for that one and for its
/// own, so that the span holds on a disk that takes up to half of it.
class CommitPace {
 public:
  using Clock = std::chrono::steady_clock;

  /// `span_s`: rows are to be safe after this long, above 0.
  explicit CommitPace(double span_s);

  /// From the first row of a group to the beginning of its commit; at least four tenths of the span, since nothing is
  /// won by haste on a slower disk.
  Clock::duration wait() const;

  /// Notes a commit that took `commit`, and whose first row was `age` old at its end. Returns a sentence where that is
  /// more than the span, one in kQuiet at most.
  std::optional<std::string> committed(Clock::duration commit, Clock::duration age, Clock::time_point now);

  /// The age of the oldest row that was ever committed.
  Clock::duration oldest() const { return oldest_; }

  static constexpr std::chrono::seconds kQuiet{10};

 private:
  static constexpr std::size_t kRecent = 64;  // commits: the one in some fifty that folds the write-ahead log is in it

  Clock::duration span_;
  std::array<Clock::duration, kRecent> recent_{};
  std::size_t next_ = 0;
  Clock::duration oldest_{0};
  Clock::duration latest_{0};  // the oldest since the last sentence
  int late_ = 0;               // groups since the last sentence
  std::optional<Clock::time_point> said_;
};

}  // namespace trivela::log
