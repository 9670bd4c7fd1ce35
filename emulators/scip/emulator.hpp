#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

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
  bool paced = true;                 ///< a scan leaves when its last beam is measured; false: as fast as they are taken
};

/// The next scan to play: its ranges, and its t_ns for the distance to the one before. None: no more, the emulator goes
/// on answering and sends no scans. Called by the emulator's thread, and only while somebody measures; must not throw.
using ScanSource = std::function<std::optional<kicking::lob::Scan>()>;

/// A scanner that is not there: speaks the device's side of SCIP 2.0, with a thread of its own. One client at a time,
/// several one after the other. A scan leaves no earlier than it was measured, and its time stamp is the emulator's own
/// clock, which runs from the start on.
class Emulator {
 public:
  /// Starts it. Throws std::runtime_error naming what the system refuses, and for a geometry that SCIP cannot say.
  Emulator(const EmulatorConfig& config, ScanSource source);
  /// Hangs up and waits for its thread.
  ~Emulator();
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  /// For open_range_finder(): a path that stays the same over pulled cables, or "tcp://127.0.0.1:PORT".
  const std::string& address() const;

  /// The line is cut: clients see it hung up, and nobody can open it. When it returns, it is cut.
  void pull_cable();
  /// It can be opened again. When it returns, it can.
  void plug_cable();

  /// One sum of each of the next `scans` scans is wrong.
  void corrupt_sums(int scans);
  /// Each of the next `scans` scans loses some bytes of its middle, a line's end among them.
  void tear_lines(int scans);
  /// The next `scans` scans are measured and not sent.
  void skip_scans(int scans);
  /// The next `replies` replies, scans among them, have this status of two characters and no data.
  void answer_with(const std::string& status, int replies);
  /// Says nothing from now on, or again. The line stays open.
  void be_silent(bool silent);

  /// The laser is on, as far as clients commanded.
  bool laser_on() const;
  /// Scans that left so far, damaged ones among them.
  std::uint64_t scans_sent() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::hal::scip
