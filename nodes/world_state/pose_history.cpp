#include "nodes/world_state/pose_history.hpp"

#include <algorithm>

namespace trivela::nodes {

using kicking::Pose;

Pose relative(const Pose& from, const Pose& to) {
  const Eigen::Vector2d position = kicking::to_robot(from, {to.x_m, to.y_m});
  return {position.x(), position.y(), kicking::wrap_angle(to.heading_rad - from.heading_rad)};
}

Pose compose(const Pose& from, const Pose& step) {
  const Eigen::Vector2d position = kicking::to_field(from, {step.x_m, step.y_m});
  return {position.x(), position.y(), kicking::wrap_angle(from.heading_rad + step.heading_rad)};
}

void PoseHistory::add(std::int64_t t_ns, const Pose& pose) {
  if (!entries_.empty() && t_ns <= entries_.back().t_ns) entries_.clear();
  entries_.push_back({t_ns, pose});
  while (entries_.front().t_ns < t_ns - span_ns_) entries_.pop_front();
}

std::optional<Pose> PoseHistory::at(std::int64_t t_ns) const {
  if (entries_.empty()) return std::nullopt;
  const auto after = std::lower_bound(entries_.begin(), entries_.end(), t_ns,
                                      [](const Entry& entry, std::int64_t t) { return entry.t_ns < t; });
  if (after == entries_.end()) return entries_.back().pose;
  if (after == entries_.begin() || after->t_ns == t_ns) return after->pose;
  const Entry& before = *std::prev(after);
  const double share = static_cast<double>(t_ns - before.t_ns) / static_cast<double>(after->t_ns - before.t_ns);
  const Pose step = relative(before.pose, after->pose);
  return compose(before.pose, {step.x_m * share, step.y_m * share, step.heading_rad * share});
}

}  // namespace trivela::nodes
