#include "hal/replay/replay_topics.hpp"

namespace trivela::hal {

std::optional<std::int64_t> ReplayTopics::next_t_ns() const {
  std::optional<std::int64_t> earliest;
  const auto look = [&](const auto& topic) {
    if (const auto* const sample = topic.peek(); sample && (!earliest || sample->t_ns < *earliest))
      earliest = sample->t_ns;
  };
  std::apply([&](const auto&... topic) { (look(topic), ...); }, topics_);
  return earliest;
}

std::optional<ReplayedSample> ReplayTopics::next() {
  const auto t_ns = next_t_ns();
  std::optional<ReplayedSample> sample;
  const auto take = [&](auto& topic) {
    if (!sample && topic.peek() && topic.peek()->t_ns == t_ns) sample = topic.next();
  };
  std::apply([&](auto&... topic) { (take(topic), ...); }, topics_);
  return sample;
}

}  // namespace trivela::hal
