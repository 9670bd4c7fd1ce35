#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "emulators/cia402/emulated_drive.hpp"
#include "emulators/line/emulator.hpp"

namespace trivela::hal::cia402 {

/// Drives with the nodes 1, 2, 3 and so on that share a bus.
class EmulatedDrives final : public EmulatedDevice {
 public:
  explicit EmulatedDrives(std::uint8_t count);

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  static std::unique_ptr<EmulatedSocket> open_line() { return emulated_bus("cia402", "can"); }

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override;
  std::vector<std::string> tick(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;

  /// The drive with this node.
  EmulatedDrive& drive(std::uint8_t node) { return drives_.at(node - 1U); }
  const std::vector<EmulatedDrive>& drives() const { return drives_; }

  /// What the bus says by itself: error frames of the interface, other devices.
  void say(const can::Frame& frame) { to_say_.push_back(frame); }
  /// A drive has a fault.
  void fail(std::uint8_t node, std::uint16_t code, std::int64_t now_ns) { drive(node).fail(code, now_ns, to_say_); }

  /// All that was taken, frame by frame, while `recording`.
  bool recording = false;
  const std::vector<can::Frame>& taken() const { return taken_; }

 private:
  std::vector<EmulatedDrive> drives_;
  EmulatedDrive::Frames to_say_;
  std::vector<can::Frame> taken_;
};

/// Drives that are not there, behind a SOCK_SEQPACKET socket in place of a CAN bus. Emulator{4}: four of them.
using Emulator = hal::Emulator<EmulatedDrives>;

}  // namespace trivela::hal::cia402
