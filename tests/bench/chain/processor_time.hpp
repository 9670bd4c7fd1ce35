#pragma once

#include <cstdint>
#include <istream>

namespace trivela::bench {

/// What all processors have done since the machine started, in the kernel's ticks.
struct ProcessorTime {
  std::int64_t used = 0;
  std::int64_t total = 0;
};

/// Of the first line of /proc/stat; idle and waiting for a disk are not used. Throws std::runtime_error for another
/// text.
ProcessorTime processor_time(std::istream& stat);

/// Of this machine now.
ProcessorTime processor_time();

/// The share of all processors' time that was used between the two, 0..1; 0 where no tick passed.
double busy_share(const ProcessorTime& before, const ProcessorTime& after);

}  // namespace trivela::bench
