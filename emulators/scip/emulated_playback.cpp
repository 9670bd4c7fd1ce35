#include "emulators/scip/emulated_playback.hpp"

#include <algorithm>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::scip {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kLongestGap = std::chrono::seconds(1);  // within a recording

nanoseconds span(double time_s) { return nanoseconds{kicking::nanoseconds(time_s)}; }

}  // namespace

EmulatedPlayback::EmulatedPlayback(const EmulatorConfig& config, ScanSource source, Time now)
    : source_(std::move(source)),
      period_(span(config.geometry.scan_period_s)),
      measuring_takes_(span(static_cast<double>(config.geometry.beams) * config.geometry.beam_period_s)),
      switched_on_(now),
      first_stamp_ms_(config.first_stamp_ms),
      starts_(now) {}

void EmulatedPlayback::begin(Time now) {
  starts_ = std::max(starts_, now);
  if (!next_) advance();
}

std::uint32_t EmulatedPlayback::stamp_ms() const {
  const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(starts_ - switched_on_);
  return first_stamp_ms_ + static_cast<std::uint32_t>(since.count());
}

void EmulatedPlayback::advance() {
  if (ended_) return;
  auto following = source_();
  ended_ = !following;
  if (next_ && following) {
    const nanoseconds gap{following->t_ns - next_->t_ns};
    starts_ += gap > nanoseconds::zero() && gap <= kLongestGap ? gap : period_;
  }
  next_ = std::move(following);
}

void EmulatedPlayback::reset_clock(Time now) {
  switched_on_ = starts_ = now;
  first_stamp_ms_ = 0;
}

}  // namespace trivela::hal::scip
