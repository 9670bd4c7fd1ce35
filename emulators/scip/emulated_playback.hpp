#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// The next scan to play: its ranges, and its t_ns for the distance to the one before. None: no more, the emulator goes
/// on answering and sends no scans. Called only while somebody measures; must not throw.
using ScanSource = std::function<std::optional<kicking::lob::Scan>()>;

/// When an emulated scanner measures what: the scans of a source, one after the other, at the source's distances; where
/// these are not those of one recording, at the scan period. Instants are of the steady clock.
class EmulatedPlayback {
 public:
  EmulatedPlayback(const kicking::lob::ScanGeometry& geometry, std::uint32_t first_stamp_ms, ScanSource source,
                   std::int64_t now_ns);

  /// Somebody wants scans from now on.
  void begin(std::int64_t now_ns);
  /// There is a scan to come.
  bool has_next() const { return next_.has_value(); }
  /// Its last beam is measured.
  std::int64_t complete_ns() const { return starts_ns_ + measuring_takes_ns_; }
  const std::vector<std::uint32_t>& range_mm() const { return next_->range_mm; }
  /// The scanner's clock at its first beam.
  std::uint32_t stamp_ms() const;
  /// On to the one after it.
  void advance();
  /// It is measured a period later: nobody takes the scans.
  void postpone() { starts_ns_ += period_ns_; }
  /// The scanner's clock is at 0 now.
  void reset_clock(std::int64_t now_ns);

 private:
  ScanSource source_;
  std::int64_t period_ns_;
  std::int64_t measuring_takes_ns_;
  std::int64_t switched_on_ns_;
  std::uint32_t first_stamp_ms_;
  std::int64_t starts_ns_;  // beam 0 of next_
  std::optional<kicking::lob::Scan> next_;
  bool ended_ = false;
};

}  // namespace trivela::hal::scip
