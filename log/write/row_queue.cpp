#include "log/write/row_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trivela::log {
namespace {

double seconds(CommitPace::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

RowQueue::RowQueue(std::size_t capacity) : capacity_(capacity) {}

bool RowQueue::push(Row row) {
  bool wake = false;
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || rows_.size() >= capacity_) return false;
    if (rows_.empty()) first_push_ = std::chrono::steady_clock::now();
    rows_.push_back(std::move(row));
    ++pushed_;
    high_water_ = std::max(high_water_, rows_.size());
    wake = rows_.size() == 1 || rows_.size() == (capacity_ + 1) / 2;
  }
  if (wake) work_.notify_one();
  return true;
}

std::optional<std::chrono::steady_clock::time_point> RowQueue::take(std::vector<Row>& group,
                                                                    std::chrono::steady_clock::duration wait) {
  std::unique_lock lock(mutex_);
  work_.wait(lock, [&] { return !rows_.empty() || closed_; });
  if (rows_.empty()) return std::nullopt;
  const auto first_push = first_push_;
  work_.wait_until(lock, first_push + wait, [&] { return closed_ || flushing_ > 0 || 2 * rows_.size() >= capacity_; });
  group.swap(rows_);
  return first_push;
}

void RowQueue::wait_to_retry(std::chrono::duration<double> span) {
  std::unique_lock lock(mutex_);
  work_.wait_for(lock, span, [&] { return closed_ || flushing_ > 0; });
}

void RowQueue::settle(std::size_t committed, std::optional<std::string> error) {
  {
    const std::lock_guard lock(mutex_);
    committed_ += committed;
    ++tries_;
    error_ = std::move(error);
  }
  settled_.notify_all();
}

std::optional<std::string> RowQueue::flush() {
  std::unique_lock lock(mutex_);
  const std::uint64_t target = pushed_;
  const std::uint64_t tries = tries_;
  ++flushing_;
  work_.notify_one();
  settled_.wait(lock, [&] { return committed_ >= target || (tries_ > tries && error_); });
  --flushing_;
  return committed_ >= target ? std::nullopt : error_;
}

void RowQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  work_.notify_one();
}

bool RowQueue::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

std::optional<std::string> RowQueue::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

std::size_t RowQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return pushed_ - committed_;
}

std::size_t RowQueue::high_water() const {
  const std::lock_guard lock(mutex_);
  return high_water_;
}

CommitPace::CommitPace(double span_s)
    : span_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(span_s))) {
  recent_[0] = span_ / 2;  // the disk is not known yet
}

CommitPace::Clock::duration CommitPace::wait() const {
  const Clock::duration slowest = *std::ranges::max_element(recent_);
  return span_ - span_ / 10 - std::clamp(slowest, span_ / 4, span_ / 2);
}

std::optional<std::string> CommitPace::committed(Clock::duration commit, Clock::duration age, Clock::time_point now) {
  recent_[next_] = commit;
  next_ = (next_ + 1) % kRecent;
  oldest_ = std::max(oldest_, age);
  if (age <= span_) return std::nullopt;
  latest_ = std::max(latest_, age);
  ++late_;
  if (said_ && now - *said_ < kQuiet) return std::nullopt;
  said_ = now;
  return fmt::format(
      "rows waited up to {:.3f} s for the disk, {:.3g} s are allowed; the last commit took {:.3f} s ({} late)",
      seconds(std::exchange(latest_, {})), seconds(span_), seconds(commit), std::exchange(late_, 0));
}

}  // namespace trivela::log
