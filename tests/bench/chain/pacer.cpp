#include "tests/bench/chain/pacer.hpp"

#include <time.h>

namespace trivela::bench {
namespace {

constexpr std::int64_t kRehearsalNs = 500'000, kBusyWaitNs = 1'000'000;

}  // namespace

void Pacer::wait_until(std::int64_t t_ns) const {
  const std::int64_t awake_t_ns = busy_wait_ ? t_ns - kBusyWaitNs : t_ns;
  const timespec until{awake_t_ns / 1'000'000'000, awake_t_ns % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) continue;
  while (now_ns() < t_ns) continue;
}

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
  if (rehearse_) {
    wait_until(next_t_ns_ - kRehearsalNs);
    rehearse_();
  }
  wait_until(next_t_ns_);
  return Tick{batch_.first_seq + sent_++, now_ns()};
}

}  // namespace trivela::bench
