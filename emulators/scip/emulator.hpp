#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulators/line/emulator.hpp"
#include "emulators/scip/emulated_playback.hpp"
#include "emulators/scip/emulated_scanner.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

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
