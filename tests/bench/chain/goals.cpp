#include "tests/bench/chain/goals.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace trivela::bench {
namespace {

struct Goal {
  const char* contender;
  const char* reference;
  double most_times;
};

constexpr Goal kGoals[] = {
    {kListener, kBare, 1.1}, {kListener, kUdp, 1.5}, {kOne, kBareOne, 1.1}, {kSecured, kListener, 1.5}};
constexpr double kMostTimesUnderLoad = 1.5;

const Row* row_of(const std::vector<Row>& rows, const char* contender, int rate_hz, bool loaded, bool realtime) {
  const auto found = std::ranges::find_if(rows, [&](const Row& row) {
    return row.contender == contender && row.rate_hz == rate_hz && row.loaded == loaded && row.realtime == realtime;
  });
  return found == rows.end() ? nullptr : &*found;
}

/// Not compared where one of the two was not run, or nothing of it arrived (not met).
void compare(const Row* row, const Row* reference, double q, const char* than, double most,
             std::vector<std::string>& missed) {
  if (row == nullptr || reference == nullptr) return;
  const double times = quantile_us(row->latencies_ns, q) / quantile_us(reference->latencies_ns, q);
  if (times <= most) return;
  missed.push_back(fmt::format("{} at {} Hz{}: {:.2f} x {} at quantile {}, the goal is {}", row->contender,
                               row->rate_hz, row->realtime ? ", SCHED_FIFO" : "", times, than, q, most));
}

}  // namespace

std::vector<std::string> missed_goals(const std::vector<Row>& rows) {
  std::vector<std::string> missed;
  for (const Row& row : rows) {
    if (!row.loaded && !row.realtime) {
      for (const Goal& goal : kGoals) {
        if (row.contender == goal.contender)
          compare(&row, row_of(rows, goal.reference, row.rate_hz, false, false), 0.5, goal.reference, goal.most_times,
                  missed);
      }
    }
    if (row.loaded && row.realtime && row.contender == kListener)
      compare(&row, row_of(rows, kListener, row.rate_hz, false, true), 0.99, "idle", kMostTimesUnderLoad, missed);
  }
  return missed;
}

}  // namespace trivela::bench
