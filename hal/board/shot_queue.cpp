#include "hal/board/shot_queue.hpp"

#include <algorithm>

namespace trivela::hal {

void ShotQueue::add(const Shot& shot) {
  shots_.insert(std::ranges::upper_bound(shots_, shot.t_ns, {}, &Shot::t_ns), shot);
}

void ShotQueue::withdraw(std::int64_t kick_id) {
  std::erase_if(shots_, [=](const Shot& shot) { return shot.kick_id == kick_id; });
}

std::optional<Shot> ShotQueue::take_due(std::int64_t now_ns) {
  if (next_ns() > now_ns || shots_.empty()) return std::nullopt;
  const Shot shot = shots_.front();
  shots_.erase(shots_.begin());
  return shot;
}

}  // namespace trivela::hal
