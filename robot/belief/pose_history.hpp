#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/geometry/time.hpp"
#include "kicking/geometry/turned_pose.hpp"

namespace trivela::robot {

/// The odometry poses of the last `span_s`, to look up any instant in between.
class PoseHistory {
 public:
  explicit PoseHistory(double span_s) : span_ns_(kicking::nanoseconds(span_s)) {}

  /// Appends; an instant that is not newer than the last one starts the history again.
  void add(std::int64_t t_ns, const kicking::Pose& pose);

  bool empty() const { return count_ == 0; }
  const kicking::TurnedPose& latest() const { return entry(count_ - 1).pose; }

  /// Linear interpolation between the neighbours; the oldest or newest entry outside the span; nullopt when empty.
  std::optional<kicking::TurnedPose> at(std::int64_t t_ns) const;

 private:
  struct Entry {
    std::int64_t t_ns;
    kicking::TurnedPose pose;
  };
  std::size_t place(std::size_t i) const { return (first_ + i) & mask_; }
  const Entry& entry(std::size_t i) const { return ring_[place(i)]; }  // 0: the oldest
  void grow();

  std::int64_t span_ns_;
  std::vector<Entry> ring_ = std::vector<Entry>(64);  // a power of two; grows where more fit into the span
  std::size_t mask_ = ring_.size() - 1;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace trivela::robot
