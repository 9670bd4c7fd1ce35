#pragma once

#include <cstdint>
#include <optional>

namespace trivela::hal {

/// From a device's clock, which counts ticks in so many bits and starts over, to the host's clock.
///
/// A stamp cannot arrive before it was made, and some arrive late: the host was busy. The clocks' distance is therefore
/// the least of all arrival - stamp - least_delay so far. It may grow by kDrift of the time that passes, so that a
/// device whose clock runs slow is followed; a fast one is anyhow. A stamp that runs backwards, or ahead of the host by
/// more than a second, starts again.
class DeviceClock {
 public:
  static constexpr double kDrift = 2e-4;

  /// least_delay_ns: from the stamp's instant to the first at which it can be here, >= 0.
  DeviceClock(std::int64_t tick_ns, unsigned bits, std::int64_t least_delay_ns)
      : tick_ns_(tick_ns), turn_(std::int64_t{1} << bits), least_delay_ns_(least_delay_ns) {}

  struct Instant {
    std::int64_t t_ns = 0;                  ///< of the stamp, in the host's clock; to the device's tick
    std::optional<std::int64_t> gap_ticks;  ///< since the last stamp; none: the first, or the first after a new start
  };

  /// The instant of a stamp, whose bits beyond those of the clock are ignored, that arrived at arrival_ns.
  Instant add(std::uint32_t stamp, std::int64_t arrival_ns);

 private:
  std::int64_t tick_ns_;
  std::int64_t turn_;  // ticks
  std::int64_t least_delay_ns_;
  bool started_ = false;
  std::int64_t device_ticks_ = 0;  // unwrapped
  std::int64_t offset_ns_ = 0;     // host - device
};

}  // namespace trivela::hal
