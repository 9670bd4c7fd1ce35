#include "robot/belief/pose_history.hpp"

#include <utility>

namespace trivela::robot {

using kicking::Pose;
using kicking::TurnedPose;

void PoseHistory::grow() {
  std::vector<Entry> larger(2 * ring_.size());
  for (std::size_t i = 0; i < count_; ++i) larger[i] = entry(i);
  ring_ = std::move(larger);
  mask_ = ring_.size() - 1;
  first_ = 0;
}

void PoseHistory::add(std::int64_t t_ns, const Pose& pose) {
  if (count_ > 0 && t_ns <= entry(count_ - 1).t_ns) count_ = 0;
  while (count_ > 0 && entry(0).t_ns < t_ns - span_ns_) {
    first_ = place(1);
    --count_;
  }
  if (count_ == ring_.size()) grow();
  ring_[place(count_++)] = {t_ns, TurnedPose{pose}};
}

std::optional<TurnedPose> PoseHistory::at(std::int64_t t_ns) const {
  if (count_ == 0) return std::nullopt;
  if (entry(count_ - 1).t_ns < t_ns) return entry(count_ - 1).pose;
  std::size_t after = count_ - 1;  // the first that is not before t_ns; pictures are of a few cycles ago
  while (after > 0 && entry(after - 1).t_ns >= t_ns) --after;
  const Entry& next = entry(after);
  if (after == 0 || next.t_ns == t_ns) return next.pose;
  const Entry& before = entry(after - 1);
  const double share = static_cast<double>(t_ns - before.t_ns) / static_cast<double>(next.t_ns - before.t_ns);
  const Pose step = relative(before.pose, next.pose);
  return TurnedPose{compose(before.pose, {step.x_m * share, step.y_m * share, step.heading_rad * share})};
}

}  // namespace trivela::robot
