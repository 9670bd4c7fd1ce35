#pragma once

#include <cstdint>
#include <optional>

namespace trivela::hal::scip {

/// From a scanner's clock, milliseconds in 24 bits that start over every 4.66 hours, to the host's clock.
///
/// A reply cannot arrive before its scan was measured, and some arrive late: the host was busy. The clocks' distance is
/// therefore the least of all arrival - stamp - least_delay so far. It may grow by kDrift of the time that passes, so
/// that a scanner whose clock runs slow is followed; a fast one is anyhow. A stamp that runs backwards, or ahead of the
/// host by more than a second, starts anew.
class ScanClock {
 public:
  static constexpr double kDrift = 2e-4;

  /// least_delay_ns: from beam 0 to the first instant at which the reply can be here, >= 0.
  explicit ScanClock(std::int64_t least_delay_ns) : least_delay_ns_(least_delay_ns) {}

  struct Instant {
    std::int64_t t_ns = 0;               ///< of beam 0, in the host's clock; to the scanner's millisecond
    std::optional<std::int64_t> gap_ms;  ///< since the last stamp; none: the first, or the first after a new start
  };

  /// The instant of a reply with this stamp, its upper 8 bits are ignored, that arrived at arrival_ns.
  Instant add(std::uint32_t stamp_ms, std::int64_t arrival_ns);

 private:
  std::int64_t least_delay_ns_;
  bool started_ = false;
  std::int64_t device_ms_ = 0;  // unwrapped
  std::int64_t offset_ns_ = 0;  // host - scanner
};

}  // namespace trivela::hal::scip
