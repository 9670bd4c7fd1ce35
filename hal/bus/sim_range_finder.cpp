#include "hal/bus/sim_range_finder.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bus/renewal.hpp"

namespace trivela::hal {
namespace {

constexpr std::chrono::seconds kLongest{1};
constexpr std::uint64_t kMostSkipped = 10'000;  // minutes of scans; a number farther ahead is not a true one

}  // namespace

SimRangeFinder::SimRangeFinder(const bus::Participant& participant, std::uint8_t robot_id)
    : robot_id_(robot_id), reader_(participant, {.period = {}, .keep_all = true, .on_liveliness = {}}) {}

void SimRangeFinder::take() {
  bus::renew_if_silent(reader_);
  reader_.take([this](const msg::SimScan& sample) {
    if (sample.robot_id != robot_id_) return;
    geometry_ = {.beams = std::min<std::size_t>(sample.beam_count, std::size(sample.range_mm)),
                 .first_angle_rad = sample.first_angle_rad,
                 .step_rad = sample.step_rad,
                 .beam_period_s = sample.beam_period_s,
                 .scan_period_s = sample.scan_period_s,
                 .min_range_m = sample.min_range_m,
                 .max_range_m = sample.max_range_m};
    waiting_.push_back({sample.t_ns, {std::begin(sample.range_mm), std::begin(sample.range_mm) + geometry_.beams}});
    const std::uint64_t skipped = counters_.scans > 0 && sample.seq > seq_ ? sample.seq - seq_ - 1 : 0;
    if (skipped <= kMostSkipped) counters_.lost_scans += skipped;
    seq_ = sample.seq;
    ++counters_.scans;
  });
}

bool SimRangeFinder::connected(std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + std::min<std::chrono::nanoseconds>(timeout, kLongest);
  for (;;) {
    take();
    if (up()) return true;
    const auto left = deadline - std::chrono::steady_clock::now();
    if (left <= left.zero() || !reader_.wait(left)) return false;
  }
}

kicking::lob::ScannerIdentity SimRangeFinder::identity() const {
  return {.vendor = "Trivela",
          .product = "laser of the simulated world, synthetic",
          .serial = std::to_string(robot_id_),
          .firmware = "",
          .protocol = "sim/scan"};
}

std::optional<kicking::lob::Scan> SimRangeFinder::read(std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + std::min<std::chrono::nanoseconds>(timeout, kLongest);
  for (;;) {
    take();
    if (!waiting_.empty()) {
      kicking::lob::Scan scan = std::move(waiting_.front());
      waiting_.pop_front();
      return scan;
    }
    const auto left = deadline - std::chrono::steady_clock::now();
    if (left <= left.zero() || !reader_.wait(left)) return std::nullopt;
  }
}

std::string SimRangeFinder::status() const { return up() ? "measuring" : "no scan of a simulated laser has come"; }

}  // namespace trivela::hal
