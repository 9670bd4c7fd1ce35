#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "hal/line/line.hpp"
#include "hal/open.hpp"
#include "hal/scip/scip_range_finder.hpp"
#include "tests/hal/faulty_scanner.hpp"

namespace trivela::tests {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// No call of a range finder may take longer; a loaded machine may wake it late.
inline constexpr milliseconds kLongestCall{1200};
/// For anything to happen at all.
inline constexpr std::chrono::seconds kTimeout{20};

/// Ranges that tell the scans apart: beam i of scan n is 1000 + n + i millimetres; beam 0 an error code, n mod 20.
inline kicking::lob::Scan numbered_scan(std::uint32_t n, const kicking::lob::ScanGeometry& geometry) {
  kicking::lob::Scan scan;
  scan.t_ns = static_cast<std::int64_t>(n * geometry.scan_period_s * 1e9);
  scan.range_mm.resize(geometry.beams);
  for (std::uint32_t i = 0; i < geometry.beams; ++i) scan.range_mm[i] = 1000 + n + i;
  scan.range_mm[0] = n % kicking::lob::kFirstRange_mm;
  return scan;
}

inline std::uint32_t number_of(const kicking::lob::Scan& scan) { return scan.range_mm.at(1) - 1001; }

/// A fast scanner, so that tests are: 100 scans a second.
inline kicking::lob::ScanGeometry fast_geometry() {
  kicking::lob::ScanGeometry geometry;
  geometry.scan_period_s = 0.010;
  geometry.beam_period_s = 0.010 / 1440;
  return geometry;
}

inline std::unique_ptr<hal::Line> line_to(const std::string& address) {
  const std::string tcp = "tcp://127.0.0.1:";
  if (!address.starts_with(tcp)) return hal::serial_line(address);
  return hal::tcp_line("127.0.0.1", static_cast<std::uint16_t>(std::stoi(address.substr(tcp.size()))));
}

/// An emulator and the real client on it. Every call of the client is timed.
class ScipLink {
 public:
  explicit ScipLink(const hal::scip::EmulatorConfig& config, hal::scip::Asking asking = hal::scip::Asking::kContinuous)
      : geometry_(config.geometry),
        emulator_(config, [this] { return std::optional{numbered_scan(played_++, geometry_)}; }),
        finder_(std::make_unique<hal::scip::ScipRangeFinder>(line_to(emulator_.address()), asking)) {}

  FaultyEmulator& emulator() { return emulator_; }
  hal::RangeFinder& finder() { return *finder_; }
  void close_finder() { finder_.reset(); }
  void open_finder() { finder_ = hal::open_range_finder(emulator_.address()); }

  std::optional<kicking::lob::Scan> read(milliseconds timeout = milliseconds(200)) {
    const auto start = Clock::now();
    auto scan = finder_->read(timeout);
    EXPECT_LE(Clock::now() - start, kLongestCall);
    return scan;
  }

  /// The next scan; throws where none comes.
  kicking::lob::Scan next() {
    std::optional<kicking::lob::Scan> scan;
    if (!until([&] { return (scan = read()).has_value(); })) throw std::runtime_error("no scan: " + finder_->status());
    return *std::move(scan);
  }

  /// Reads until `done`; false: it did not happen.
  template <class Condition>
  bool until(Condition done) {
    for (const auto end = Clock::now() + kTimeout; Clock::now() < end;) {
      if (done()) return true;
    }
    return false;
  }

  /// Reads until the link is down; how long that took.
  milliseconds until_down() {
    const auto start = Clock::now();
    EXPECT_TRUE(until([&] { return read(milliseconds(20)), !finder_->up(); }));
    return std::chrono::duration_cast<milliseconds>(Clock::now() - start);
  }

 private:
  kicking::lob::ScanGeometry geometry_;
  std::uint32_t played_ = 0;
  FaultyEmulator emulator_;
  std::unique_ptr<hal::RangeFinder> finder_;
};

}  // namespace trivela::tests
