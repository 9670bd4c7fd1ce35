#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "emulators/scip/emulator.hpp"

namespace trivela::hal::scip {

/// When an emulated scanner measures what: the scans of a source, one after the other, at the source's distances; where
/// these are not those of one recording, at the scan period. Time comes in through arguments.
class EmulatedPlayback {
 public:
  using Time = std::chrono::steady_clock::time_point;

  EmulatedPlayback(const EmulatorConfig& config, ScanSource source, Time now);

  /// Somebody wants scans from now on.
  void begin(Time now);
  /// There is a scan to come.
  bool has_next() const { return next_.has_value(); }
  /// Its last beam is measured.
  Time complete() const { return starts_ + measuring_takes_; }
  const std::vector<std::uint32_t>& range_mm() const { return next_->range_mm; }
  /// The scanner's clock at its first beam.
  std::uint32_t stamp_ms() const;
  /// On to the one after it.
  void advance();
  /// It is measured a period later: nobody takes the scans.
  void postpone() { starts_ += period_; }
  /// The scanner's clock is at 0 now.
  void reset_clock(Time now);

 private:
  ScanSource source_;
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds measuring_takes_;
  Time switched_on_;
  std::uint32_t first_stamp_ms_;
  Time starts_;  // beam 0 of next_
  std::optional<kicking::lob::Scan> next_;
  bool ended_ = false;
};

}  // namespace trivela::hal::scip
