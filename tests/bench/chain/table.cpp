#include "tests/bench/chain/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace trivela::bench {

double quantile_us(std::vector<std::int64_t> values_ns, double q) {
  if (values_ns.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(q * static_cast<double>(values_ns.size()))) - 1;
  const auto at = values_ns.begin() + std::max<std::ptrdiff_t>(rank, 0);
  std::nth_element(values_ns.begin(), at, values_ns.end());
  return static_cast<double>(*at) / 1000.0;
}

void print_heading() {
  fmt::print("{:>7} {:<6} {:<11} {:<30} {:>7} {:>7} {:>9} {:>9} {:>9} {:>7}\n", "rate_hz", "load", "scheduling",
             "chain", "samples", "skipped", "p50_us", "p99_us", "worst_us", "x UDP");
}

void print_row(const Row& row, double reference_p50_us) {
  const double p50_us = quantile_us(row.latencies_ns, 0.5);
  fmt::print("{:>7} {:<6} {:<11} {:<30} {:>7} {:>7} {:>9.1f} {:>9.1f} {:>9.1f} {:>7.2f}\n", row.rate_hz,
             row.loaded ? "loaded" : "idle", row.realtime ? "SCHED_FIFO" : "SCHED_OTHER", row.contender,
             row.latencies_ns.size(), row.sent - static_cast<std::int64_t>(row.latencies_ns.size()), p50_us,
             quantile_us(row.latencies_ns, 0.99), quantile_us(row.latencies_ns, 1.0), p50_us / reference_p50_us);
  std::fflush(stdout);
}

}  // namespace trivela::bench
