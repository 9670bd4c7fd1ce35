#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace trivela::cli {

/// Hands out matches to workers and gives their results back in the order of the matches. Workers are never more than
/// `ahead` matches before the one that is waited for.
template <class Result>
class MatchQueue {
 public:
  MatchQueue(std::uint32_t first, std::uint32_t end, std::uint32_t ahead)
      : next_(first), awaited_(first), end_(end), ahead_(ahead) {}

  /// The next match to play; none: all are given out, or somebody closed the queue.
  std::optional<std::uint32_t> next() {
    std::unique_lock lock{mutex_};
    changed_.wait(lock, [&] { return closed_ || next_ == end_ || next_ < awaited_ + ahead_; });
    if (closed_ || next_ == end_) return std::nullopt;
    return next_++;
  }

  void done(std::uint32_t match, Result result) {
    const std::lock_guard lock{mutex_};
    results_.emplace(match, std::move(result));
    changed_.notify_all();
  }

  /// A worker could not go on.
  void fail(std::exception_ptr why) {
    const std::lock_guard lock{mutex_};
    if (!failure_) failure_ = std::move(why);
    closed_ = true;
    changed_.notify_all();
  }

  /// The result of the next match in order, waited for up to `timeout`. Throws what a worker failed with.
  std::optional<Result> take(auto timeout) {
    std::unique_lock lock{mutex_};
    changed_.wait_for(lock, timeout, [&] { return failure_ || results_.contains(awaited_); });
    if (failure_) std::rethrow_exception(failure_);
    auto found = results_.extract(awaited_);
    if (found.empty()) return std::nullopt;
    ++awaited_;
    changed_.notify_all();
    return std::move(found.mapped());
  }

  /// No more matches are given out.
  void close() {
    const std::lock_guard lock{mutex_};
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t next_;
  std::uint32_t awaited_;
  std::uint32_t end_;
  std::uint32_t ahead_;
  std::map<std::uint32_t, Result> results_;
  std::exception_ptr failure_;
  bool closed_ = false;
};

}  // namespace trivela::cli
