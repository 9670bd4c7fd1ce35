#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace trivela::experiment {

/// Hands out matches to workers, and their results, in the order of the matches, to one of them at a time: who finishes
/// the match that is waited for takes along those that wait behind it. Workers are never more than `ahead` matches
/// before it.
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

  /// A match is played. `use(match, result)` is called, by this worker or by the one that is at it, never by two at
  /// once.
  void done(std::uint32_t match, Result result, const auto& use) {
    std::unique_lock lock{mutex_};
    results_.emplace(match, std::move(result));
    if (in_use_) return;
    in_use_ = true;
    while (auto found = results_.extract(awaited_)) {
      lock.unlock();
      use(found.key(), found.mapped());
      lock.lock();
      ++awaited_;
      changed_.notify_all();
    }
    in_use_ = false;
  }

  /// A worker could not go on.
  void fail(std::exception_ptr why) {
    const std::lock_guard lock{mutex_};
    if (!failure_) failure_ = std::move(why);
    closed_ = true;
    changed_.notify_all();
  }

  /// Waits up to `timeout` for all results to be used; the first match whose result is not. Throws what a worker failed
  /// with.
  std::uint32_t wait(auto timeout) {
    std::unique_lock lock{mutex_};
    changed_.wait_for(lock, timeout, [&] { return failure_ || awaited_ == end_; });
    if (failure_) std::rethrow_exception(failure_);
    return awaited_;
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
  bool in_use_ = false;  // a worker has results in its hands
};

}  // namespace trivela::experiment
