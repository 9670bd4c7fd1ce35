#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trivela::bench {

/// One contender under one condition.
struct Row {
  int rate_hz = 0;
  bool loaded = false;
  bool realtime = false;
  double busy = 0.0;  // of all processors' time while it ran, 0..1, ours and others'
  std::string contender = {};
  std::string reference = {};  // the contender of the same condition that it is compared with; none: UDP
  std::int64_t sent = 0;
  std::vector<std::int64_t> latencies_ns = {};
};

/// The value below which a share q of the values lies (nearest rank), in microseconds; NaN without values.
double quantile_us(std::vector<std::int64_t> values_ns, double q);

void print_heading();

/// Times are from sensor sample to order, one way; the ratios are of medians, to the first row of the same condition
/// and to the row's reference among them.
void print_row(const Row& row, const std::vector<Row>& of_the_condition);

/// The median of the contender in these rows over that of its reference; NaN without either.
double times_reference(const Row& row, const std::vector<Row>& of_the_condition);

}  // namespace trivela::bench
