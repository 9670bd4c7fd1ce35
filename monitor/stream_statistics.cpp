#include "monitor/stream_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot/watch/silence_watch.hpp"

namespace trivela::monitor {
namespace {

constexpr double kNsPerS = 1e9;
constexpr std::size_t kMostSamples = 100'000;  // of a window
constexpr std::size_t kMostLosses = 10'000;

// Beyond this an instant is of another clock, such as lockstep's.
constexpr std::int64_t kOldest_ns = 10'000'000'000;

bool is_old(std::int64_t lost_ns, std::int64_t now_ns) {
  return static_cast<double>(now_ns - lost_ns) > StreamStatistics::kNews_s * kNsPerS;
}

// The value below which a part of them lies; none of none.
std::optional<double> quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::nullopt;
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::llround(part * last));
  std::ranges::nth_element(values, nth);
  return *nth;
}

}  // namespace

std::int64_t StreamStatistics::deadlines_in(std::int64_t ns) const {
  if (period_s_ <= 0.0) return 0;
  return static_cast<std::int64_t>(static_cast<double>(ns) / (robot::kSilentPeriods * period_s_ * kNsPerS));
}

void StreamStatistics::count(std::uint8_t robot_id, const ReceivedSample& received_sample) {
  if (!received_sample.seq) return;
  const auto finding = numbers_.see(robot_id, *received_sample.seq, received_sample.writer,
                                    static_cast<double>(received_sample.received_ns) / kNsPerS);
  if (!finding.believed) return;
  if (finding.out_of_order) ++counts_.out_of_order;
  const std::int64_t lost = finding.gap - (finding.filled ? 1 : 0);
  if (lost == 0) return;
  counts_.lost += lost;
  losses_.emplace_back(received_sample.received_ns, lost);
  while (losses_.size() > kMostLosses || is_old(losses_.front().first, received_sample.received_ns))
    losses_.pop_front();
}

void StreamStatistics::see(std::uint8_t robot_id, const ReceivedSample& received_sample) {
  count(robot_id, received_sample);
  if (counts_.received++ == 0) {
    first_ns_ = received_sample.received_ns;
  } else {
    counts_.missed_deadlines += deadlines_in(received_sample.received_ns - window_.back().received_ns);
  }
  Sample sample{received_sample.received_ns,
                static_cast<double>(received_sample.received_real_ns - received_sample.source_ns) / 1e3, std::nullopt};
  const std::int64_t age_ns = received_sample.received_ns - received_sample.t_ns;
  if (age_ns >= 0 && age_ns < kOldest_ns) sample.age_ms = static_cast<double>(age_ns) / 1e6;
  window_.push_back(sample);
  // The last one stays: it is what silence is measured from.
  const auto oldest_ns = received_sample.received_ns - static_cast<std::int64_t>(kWindow_s * kNsPerS);
  while (window_.size() > kMostSamples || window_.front().received_ns < oldest_ns) window_.pop_front();
}

StreamFigures StreamStatistics::figures(std::int64_t now_ns) const {
  StreamFigures figures = counts_;
  if (window_.empty()) return figures;
  const std::int64_t silent_ns = now_ns - window_.back().received_ns;
  figures.silent_for_s = static_cast<double>(silent_ns) / kNsPerS;
  figures.missed_deadlines += deadlines_in(silent_ns);
  for (const auto& [at_ns, lost] : losses_) {
    if (!is_old(at_ns, now_ns)) figures.lost_lately += lost;
  }
  std::vector<double> latencies_us, ages_ms;
  std::int64_t in_window = 0, in_second = 0;
  for (const Sample& sample : window_) {
    const double ago_s = static_cast<double>(now_ns - sample.received_ns) / kNsPerS;
    if (ago_s > kWindow_s) continue;
    ++in_window;
    if (ago_s <= 1.0) ++in_second;
    latencies_us.push_back(sample.latency_us);
    if (sample.age_ms) ages_ms.push_back(*sample.age_ms);
  }
  // Who listens for less than that knows no more: the first sample began its count and is no part of it.
  const double known_s = static_cast<double>(now_ns - first_ns_) / kNsPerS;
  const auto rate = [&](std::int64_t n, double over_s) {
    if (known_s >= over_s) return static_cast<double>(n) / over_s;
    return known_s > 0.0 ? static_cast<double>(n - 1) / known_s : 0.0;
  };
  figures.rate_hz = rate(in_window, kWindow_s);
  figures.rate_now_hz = rate(in_second, 1.0);
  figures.latency_p50_us = quantile(latencies_us, 0.5);
  figures.latency_p99_us = quantile(latencies_us, 0.99);
  figures.age_p50_ms = quantile(ages_ms, 0.5);
  return figures;
}

}  // namespace trivela::monitor
