#include "emulators/scip/emulated_playback.hpp"

#include <algorithm>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::int64_t kLongestGap_ns = 1'000'000'000;  // within a recording
constexpr std::int64_t kNsPerMs = 1'000'000;

}  // namespace

EmulatedPlayback::EmulatedPlayback(const kicking::lob::ScanGeometry& geometry, std::uint32_t first_stamp_ms,
                                   ScanSource source, std::int64_t now_ns)
    : source_(std::move(source)),
      period_ns_(kicking::nanoseconds(geometry.scan_period_s)),
      measuring_takes_ns_(kicking::nanoseconds(static_cast<double>(geometry.beams) * geometry.beam_period_s)),
      switched_on_ns_(now_ns),
      first_stamp_ms_(first_stamp_ms),
      starts_ns_(now_ns) {}

void EmulatedPlayback::begin(std::int64_t now_ns) {
  starts_ns_ = std::max(starts_ns_, now_ns);
  if (!next_) advance();
}

std::uint32_t EmulatedPlayback::stamp_ms() const {
  return first_stamp_ms_ + static_cast<std::uint32_t>((starts_ns_ - switched_on_ns_) / kNsPerMs);
}

void EmulatedPlayback::advance() {
  if (ended_) return;
  auto following = source_();
  ended_ = !following;
  if (next_ && following) {
    const std::int64_t gap_ns = following->t_ns - next_->t_ns;
    starts_ns_ += gap_ns > 0 && gap_ns <= kLongestGap_ns ? gap_ns : period_ns_;
  }
  next_ = std::move(following);
}

void EmulatedPlayback::reset_clock(std::int64_t now_ns) {
  switched_on_ns_ = starts_ns_ = now_ns;
  first_stamp_ms_ = 0;
}

}  // namespace trivela::hal::scip
