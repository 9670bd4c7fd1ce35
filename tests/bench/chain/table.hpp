#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trivela::bench {

/// One contender under one condition.
struct Row {
  int rate_hz;
  bool loaded;
  bool realtime;
  std::string contender;
  std::int64_t sent;
  std::vector<std::int64_t> latencies_ns;
};

/// The value below which a share q of the values lies (nearest rank), in microseconds; NaN without values.
double quantile_us(std::vector<std::int64_t> values_ns, double q);

void print_heading();

/// Times are from sensor sample to order, one way; the ratio is to the median of the first row of the same condition.
void print_row(const Row& row, double reference_p50_us);

}  // namespace trivela::bench
