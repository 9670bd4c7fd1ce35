#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace trivela::nodes {

/// From the thread of one bus to that of the other, so that neither ever waits for the other: of what nobody takes, the
/// latest kMost are kept.
template <class T>
class BoundedQueue {
 public:
  static constexpr std::size_t kMost = 64;

  void put(T value) {
    {
      const std::lock_guard lock{mutex_};
      values_.push_back(std::move(value));
      if (values_.size() > kMost) values_.pop_front();
    }
    filled_.notify_one();
  }

  /// The oldest, waiting for one no longer than the timeout.
  std::optional<T> next(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    if (!filled_.wait_for(lock, timeout, [this] { return !values_.empty(); })) return std::nullopt;
    std::optional<T> value{std::move(values_.front())};
    values_.pop_front();
    return value;
  }

  void clear() {
    const std::lock_guard lock{mutex_};
    values_.clear();
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<T> values_;
};

}  // namespace trivela::nodes
