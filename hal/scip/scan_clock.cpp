#include "hal/scip/scan_clock.hpp"

#include <algorithm>

namespace trivela::hal::scip {
namespace {

constexpr std::int64_t kTurn_ms = std::int64_t{1} << 24U;
constexpr std::int64_t kStep_ns = 1'000'000'000;
constexpr std::int64_t kNsPerMs = 1'000'000;

}  // namespace

ScanClock::Instant ScanClock::add(std::uint32_t stamp_ms, std::int64_t arrival_ns) {
  const std::int64_t gap_ms = (std::int64_t{stamp_ms} - device_ms_) & (kTurn_ms - 1);
  const std::int64_t next_ms = device_ms_ + gap_ms;
  const std::int64_t seen_ns = arrival_ns - least_delay_ns_ - next_ms * kNsPerMs;
  const bool backwards = gap_ms >= kTurn_ms / 2;
  if (!started_ || backwards || seen_ns < offset_ns_ - kStep_ns) {
    started_ = true;
    device_ms_ = std::int64_t{stamp_ms} & (kTurn_ms - 1);
    offset_ns_ = arrival_ns - least_delay_ns_ - device_ms_ * kNsPerMs;
    return {device_ms_ * kNsPerMs + offset_ns_, std::nullopt};
  }
  const auto drift_ns = static_cast<std::int64_t>(kDrift * static_cast<double>(gap_ms * kNsPerMs));
  device_ms_ = next_ms;
  offset_ns_ = std::min(seen_ns, offset_ns_ + drift_ns);
  return {device_ms_ * kNsPerMs + offset_ns_, gap_ms};
}

}  // namespace trivela::hal::scip
