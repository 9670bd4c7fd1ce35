#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/line/device_clock.hpp"
#include "hal/range_finder.hpp"
#include "hal/scip/messages.hpp"
#include "hal/scip/reply.hpp"
#include "hal/scip/start_up.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// From a scanner's clock, milliseconds in 24 bits that start over every 4.66 hours, to the host's clock.
class ScanClock {
 public:
  static constexpr double kDrift = DeviceClock::kDrift;

  /// least_delay_ns: from beam 0 to the first instant at which the reply can be here, >= 0.
  explicit ScanClock(std::int64_t least_delay_ns) : clock_(1'000'000, 24, least_delay_ns) {}

  struct Instant {
    std::int64_t t_ns = 0;               ///< of beam 0, in the host's clock; to the scanner's millisecond
    std::optional<std::int64_t> gap_ms;  ///< since the last stamp; none: the first, or the first after a new start
  };

  /// The instant of a reply with this stamp, its upper 8 bits are ignored, that arrived at arrival_ns.
  Instant add(std::uint32_t stamp_ms, std::int64_t arrival_ns) {
    const auto [t_ns, gap_ms] = clock_.add(stamp_ms, arrival_ns);
    return {t_ns, gap_ms};
  }

 private:
  DeviceClock clock_;
};

/// From the replies to one MD, or to GDs, to scans. No clock, no line.
class ScanIntake {
 public:
  ScanIntake(Asking asking, const Parameters& parameters);

  const kicking::lob::ScanGeometry& geometry() const { return geometry_; }
  /// The MD or GD.
  const std::string& request() const { return request_; }

  /// The scan of a reply that arrived at arrival_ns. None: it holds none, and is counted where it should.
  std::optional<kicking::lob::Scan> take(const Reply& reply, std::int64_t arrival_ns, LinkCounters& counters);

  /// What the scanner said instead of the last scan; empty: nothing.
  const std::string& complaint() const { return complaint_; }

 private:
  Asking asking_;
  kicking::lob::ScanGeometry geometry_;
  std::string request_;
  ScanClock clock_;
  std::string complaint_;
};

}  // namespace trivela::hal::scip
