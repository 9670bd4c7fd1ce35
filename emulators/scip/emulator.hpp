#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulators/line/emulator.hpp"
#include "emulators/scip/emulated_scanner.hpp"
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

/// Where an emulated scanner is plugged in: a pseudo-terminal, or a TCP port on the loopback interface.
enum class EmulatedPort { kTerminal, kTcp };

/// What an emulated scanner is.
struct EmulatorConfig {
  EmulatedPort port = EmulatedPort::kTerminal;
  std::uint16_t tcp_port = 0;  ///< 0: any free one
  kicking::lob::ScannerIdentity identity{kicking::lob::kEmulatedVendor, "SCIP emulator", "E0000001", "1.0.0",
                                         "SCIP 2.0"};
  kicking::lob::ScanGeometry geometry{};
  int first_step = 0;                ///< AMIN, the step of beam 0
  std::uint32_t first_stamp_ms = 0;  ///< its clock when it starts, 24 bit
};

/// The device's side of SCIP 2.0 on a line. A scan leaves when its last beam is measured, and its time stamp is the
/// device's own clock, which runs from the start on.
class EmulatedRangeFinder : public EmulatedDevice {
 public:
  /// `source` is called by the line's thread. Throws std::runtime_error for a geometry that SCIP cannot say.
  EmulatedRangeFinder(const EmulatorConfig& config, ScanSource source);

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  std::unique_ptr<EmulatedSocket> open_line() const;

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override;
  std::int64_t next_ns() const override;
  std::vector<std::string> tick(std::int64_t now_ns) override;
  void hang_up() override;

  /// The laser is on, as far as clients commanded.
  bool laser_on() const { return scanner_.laser_on(); }

 private:
  void note_measuring(std::int64_t now_ns);

  EmulatedPort port_;
  std::uint16_t tcp_port_;
  EmulatedScanner scanner_;
  EmulatedPlayback playback_;
  bool was_measuring_ = false;
  std::string request_;  // so far
};

/// A scanner that is not there. Its address is for open_range_finder().
using Emulator = hal::Emulator<EmulatedRangeFinder>;

}  // namespace trivela::hal::scip
