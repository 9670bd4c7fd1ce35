#pragma once

#include <cstdint>
#include <vector>

namespace trivela::bench {

/// What is measured at one far end, an emulated ioBoard: until its thread has read the last byte of the frame [ns].
struct DriverSpans {
  std::vector<std::int64_t> bare_ns;   ///< after a bare write() began
  std::vector<std::int64_t> order_ns;  ///< after the KickOrder to fire now was given to the bus
  std::vector<std::int64_t> late_ns;   ///< after the instant of a shot that was ordered 13 ms before
  std::int64_t refused = 0;            ///< orders without a pulse within a second, which are ordered again
};

/// Shots of each kind, in turns, through a process trivela-kicker_driver, which runs with `--realtime priority` where
/// that is above 0. Throws std::runtime_error with what the driver said where it never gets ready.
DriverSpans measure_driver(int shots, int priority);

}  // namespace trivela::bench
