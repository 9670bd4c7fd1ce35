#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "experiment/replay/row_pages.hpp"

namespace trivela::experiment {

/// The recorded samples of one topic, of which a node has the latest that came.
template <bus::Message T>
class InputStream {
 public:
  explicit InputStream(const RecordedRobot& robot) : pages_(robot) {}

  /// How many samples have come by then that the node does not have yet.
  std::size_t come_by(std::int64_t t_ns) {
    while (pages_.peek() != nullptr && pages_.peek()->t_ns <= t_ns) ahead_.push_back(*pages_.next());
    std::size_t count = 0;
    while (count < ahead_.size() && ahead_[count].t_ns <= t_ns) ++count;
    return count;
  }

  /// What it has when so many of come_by() have come; nullptr: nothing yet.
  const T* after(std::size_t count) const {
    if (count > 0) return &ahead_[count - 1];
    return latest_ ? &*latest_ : nullptr;
  }

  /// They have come.
  void take(std::size_t count) {
    if (count == 0) return;
    latest_ = ahead_[count - 1];
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(count));
  }

 private:
  RowPages<T> pages_;
  std::deque<T> ahead_;
  std::optional<T> latest_;
};

}  // namespace trivela::experiment
