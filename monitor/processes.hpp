#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::monitor {

/// What the kernel says of a process at one moment.
struct ProcessReading {
  std::int64_t memory_bytes = 0;  ///< resident
  double cpu_s = 0.0;             ///< used since it began, user and system
};

/// Of the texts of /proc/PID/stat and /proc/PID/statm; none: they are something else, or of a process that has ended.
std::optional<ProcessReading> parse_process(std::string_view stat, std::string_view statm, double ticks_per_s,
                                            std::int64_t page_bytes);

/// Of a process on this machine; none: there is none of that id.
std::optional<ProcessReading> read_process(std::int64_t pid);

/// What a process takes.
struct ProcessLoad {
  std::int64_t memory_bytes = 0;
  std::optional<double> cpu_percent;  ///< of one core since the look before; none at the first
};

/// Memory and processor time of processes, look by look.
class ProcessLoads {
 public:
  using Clock = std::chrono::steady_clock;

  /// None: there is no such process, or no longer.
  std::optional<ProcessLoad> look(std::int64_t pid, const std::optional<ProcessReading>& reading,
                                  Clock::time_point now);

 private:
  struct Before {
    double cpu_s;
    Clock::time_point at;
  };
  std::map<std::int64_t, Before> before_;
};

}  // namespace trivela::monitor
