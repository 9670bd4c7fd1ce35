#include "tests/bench/chain/processor_time.hpp"

#include <fstream>
#include <stdexcept>
#include <string>

namespace trivela::bench {

ProcessorTime processor_time(std::istream& stat) {
  constexpr int kIdle = 3, kIoWait = 4,
                kColumns = 8;  // user nice system idle iowait irq softirq steal; guests are users
  std::string word;
  if (!(stat >> word) || word != "cpu") throw std::runtime_error("/proc/stat does not begin with cpu");
  ProcessorTime time;
  for (int column = 0; column < kColumns; ++column) {
    std::int64_t ticks = 0;
    if (!(stat >> ticks)) throw std::runtime_error("/proc/stat has fewer than eight times");
    time.total += ticks;
    if (column != kIdle && column != kIoWait) time.used += ticks;
  }
  return time;
}

ProcessorTime processor_time() {
  std::ifstream stat("/proc/stat");
  return processor_time(stat);
}

double busy_share(const ProcessorTime& before, const ProcessorTime& after) {
  const std::int64_t total = after.total - before.total;
  return total <= 0 ? 0.0 : static_cast<double>(after.used - before.used) / static_cast<double>(total);
}

}  // namespace trivela::bench
