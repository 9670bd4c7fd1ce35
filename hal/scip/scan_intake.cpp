#include "hal/scip/scan_intake.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::scip {
namespace {

// From beam 0 to the last: no reply can be here earlier.
std::int64_t measuring_ns(const kicking::lob::ScanGeometry& geometry) {
  return kicking::nanoseconds(static_cast<double>(geometry.beams) * geometry.beam_period_s);
}

}  // namespace

ScanIntake::ScanIntake(Asking asking, const Parameters& parameters)
    : asking_(asking), geometry_(geometry_of(parameters)), clock_(measuring_ns(geometry_)) {
  const Section section = whole_section(parameters);
  request_ = asking == Asking::kContinuous ? measure_request(section) : get_request(section);
}

std::optional<kicking::lob::Scan> ScanIntake::take(const Reply& reply, std::int64_t arrival_ns,
                                                   LinkCounters& counters) {
  if (!reply.echo.starts_with(std::string_view{request_}.substr(0, kMeasureEchoStays))) {
    ++counters.torn_lines;
    return std::nullopt;
  }
  const bool accepted = asking_ == Asking::kContinuous && reply.status == "00" && reply.data.empty();
  if (accepted) return std::nullopt;
  if (reply.status != "00" && reply.status != "99") {
    ++counters.error_replies;
    complaint_ = meaning(request_, reply.status);
    return std::nullopt;
  }
  auto ranges = ranges_of(reply, geometry_.beams);
  if (!ranges || !reply.stamp_ms) {
    ++counters.torn_lines;
    return std::nullopt;
  }
  const ScanClock::Instant instant = clock_.add(*reply.stamp_ms, arrival_ns);
  if (instant.gap_ms && asking_ == Asking::kContinuous) {
    const auto periods = std::llround(static_cast<double>(*instant.gap_ms) * 1e-3 / geometry_.scan_period_s);
    if (periods > 1) counters.lost_scans += static_cast<std::uint64_t>(periods - 1);
  }
  ++counters.scans;
  counters.error_ranges += static_cast<std::uint64_t>(std::ranges::count_if(
      *ranges, [](std::uint32_t range) { return range > 0 && range < kicking::lob::kFirstRange_mm; }));
  complaint_.clear();
  return kicking::lob::Scan{instant.t_ns, std::move(*ranges)};
}

}  // namespace trivela::hal::scip
