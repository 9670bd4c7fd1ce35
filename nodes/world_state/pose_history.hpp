#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "kicking/geometry/frames.hpp"

namespace trivela::nodes {

/// `to` seen from `from`: position in the frame of `from`, heading relative to it.
kicking::Pose relative(const kicking::Pose& from, const kicking::Pose& to);

/// The pose reached from `from` by the relative step `step`; compose(a, relative(a, b)) = b.
kicking::Pose compose(const kicking::Pose& from, const kicking::Pose& step);

/// The odometry poses of the last `span_s`, to look up any instant in between.
class PoseHistory {
 public:
  explicit PoseHistory(double span_s) : span_ns_(static_cast<std::int64_t>(span_s * 1e9)) {}

  /// Appends; an instant that is not newer than the last one starts the history anew.
  void add(std::int64_t t_ns, const kicking::Pose& pose);

  bool empty() const { return entries_.empty(); }
  const kicking::Pose& latest() const { return entries_.back().pose; }

  /// Linear interpolation between the neighbours; the oldest or newest entry outside the span; nullopt when empty.
  std::optional<kicking::Pose> at(std::int64_t t_ns) const;

 private:
  struct Entry {
    std::int64_t t_ns;
    kicking::Pose pose;
  };
  std::int64_t span_ns_;
  std::deque<Entry> entries_;
};

}  // namespace trivela::nodes
