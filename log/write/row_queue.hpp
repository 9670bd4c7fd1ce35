#pragma once

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

}  // namespace trivela::log
