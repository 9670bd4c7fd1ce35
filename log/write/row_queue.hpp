#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "log/schema/row.hpp"

namespace trivela::log {

struct Row {
  std::size_t table = 0;
  std::vector<Value> values;
};

/// Bounded queue between the threads that push rows and the one that writes them in groups.
class RowQueue {
 public:
  explicit RowQueue(std::size_t capacity);

  /// False: full or closed. Waits for nothing but other pushes.
  bool push(Row row);

  /// Moves all rows to the empty `group`, once `wait` has passed since the first one was pushed, or at once where the
  /// queue is half full, closed or flushed. Returns when that was; none: closed and nothing left.
  std::optional<std::chrono::steady_clock::time_point> take(std::vector<Row>& group,
                                                            std::chrono::steady_clock::duration wait);

  /// Waits `span` before a refused group is tried again, less where the queue is closed or flushed.
  void wait_to_retry(std::chrono::duration<double> span);

  /// The writing thread reports a try: the rows that it committed, or what went wrong.
  void settle(std::size_t committed, std::optional<std::string> error);

  /// Waits until all rows pushed before are committed, or a try fails: then that error.
  std::optional<std::string> flush();

  /// No more rows; lets `take` return false after the last ones.
  void close();

  bool closed() const;
  std::optional<std::string> error() const;  ///< of the last try
  std::size_t waiting() const;               ///< pushed and not committed
  std::size_t high_water() const;            ///< most rows that ever waited to be taken

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable work_;     // for the writing thread
  std::condition_variable settled_;  // for those who flush
  std::vector<Row> rows_;
  std::chrono::steady_clock::time_point first_push_;  // of rows_
  std::size_t high_water_ = 0;
  std::uint64_t pushed_ = 0;
  std::uint64_t committed_ = 0;
  std::uint64_t tries_ = 0;
  int flushing_ = 0;
  bool closed_ = false;
  std::optional<std::string> error_;
};

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
