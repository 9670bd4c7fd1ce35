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

double times_reference(const Row& row, const std::vector<Row>& of_the_condition) {
  const auto reference =
      std::ranges::find_if(of_the_condition, [&](const Row& other) { return other.contender == row.reference; });
  if (reference == of_the_condition.end()) return std::numeric_limits<double>::quiet_NaN();
  return quantile_us(row.latencies_ns, 0.5) / quantile_us(reference->latencies_ns, 0.5);
}

void print_heading() {
  fmt::print("{:>7} {:<6} {:<11} {:>5} {:<32} {:>7} {:>7} {:>9} {:>9} {:>9} {:>7}  {}\n", "rate_hz", "load",
             "scheduling", "busy", "chain", "samples", "skipped", "p50_us", "p99_us", "worst_us", "x UDP", "beside");
}

void print_row(const Row& row, const std::vector<Row>& of_the_condition) {
  const double p50_us = quantile_us(row.latencies_ns, 0.5);
  const double udp_us = quantile_us(of_the_condition.front().latencies_ns, 0.5);
  fmt::print("{:>7} {:<6} {:<11} {:>3.0f} % {:<32} {:>7} {:>7} {:>9.1f} {:>9.1f} {:>9.1f} {:>7.2f}", row.rate_hz,
             row.loaded ? "loaded" : "idle", row.realtime ? "SCHED_FIFO" : "SCHED_OTHER", 100.0 * row.busy,
             row.contender, row.latencies_ns.size(), row.sent - static_cast<std::int64_t>(row.latencies_ns.size()),
             p50_us, quantile_us(row.latencies_ns, 0.99), quantile_us(row.latencies_ns, 1.0), p50_us / udp_us);
  if (!row.reference.empty()) fmt::print("  {:.2f} x {}", times_reference(row, of_the_condition), row.reference);
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace trivela::bench
