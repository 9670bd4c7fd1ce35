#include "hal/line/device_clock.hpp"

#include <algorithm>

namespace trivela::hal {
namespace {

constexpr std::int64_t kClockStep_ns = 1'000'000'000;

}  // namespace

DeviceClock::Instant DeviceClock::add(std::uint32_t stamp, std::int64_t arrival_ns) {
  const std::int64_t gap_ticks = (std::int64_t{stamp} - device_ticks_) & (turn_ - 1);
  const std::int64_t next_ticks = device_ticks_ + gap_ticks;
  const std::int64_t seen_ns = arrival_ns - least_delay_ns_ - next_ticks * tick_ns_;
  const bool backwards = gap_ticks >= turn_ / 2;
  if (!started_ || backwards || seen_ns < offset_ns_ - kClockStep_ns) {
    started_ = true;
    device_ticks_ = std::int64_t{stamp} & (turn_ - 1);
    offset_ns_ = arrival_ns - least_delay_ns_ - device_ticks_ * tick_ns_;
    return {device_ticks_ * tick_ns_ + offset_ns_, std::nullopt};
  }
  const auto drift_ns = static_cast<std::int64_t>(kDrift * static_cast<double>(gap_ticks * tick_ns_));
  device_ticks_ = next_ticks;
  offset_ns_ = std::min(seen_ns, offset_ns_ + drift_ns);
  return {device_ticks_ * tick_ns_ + offset_ns_, gap_ticks};
}

}  // namespace trivela::hal
