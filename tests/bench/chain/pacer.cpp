#include "tests/bench/chain/pacer.hpp"

#include <time.h>

namespace trivela::bench {

std::optional<Pacer::Tick> Pacer::next(std::chrono::nanoseconds timeout) {
  if (batch_.count > 0 && sent_ == batch_.count) {
    batch_ = {};
    track_.batch_sent();
  }
  if (batch_.count == 0) {
    const auto ordered = track_.next_batch(timeout);
    if (!ordered) return std::nullopt;
    batch_ = *ordered;
    sent_ = 0;
    next_t_ns_ = now_ns();
  }
  next_t_ns_ += batch_.period_ns;
  const timespec until{next_t_ns_ / 1'000'000'000, next_t_ns_ % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) continue;
  return Tick{batch_.first_seq + sent_++, now_ns()};
}

}  // namespace trivela::bench
