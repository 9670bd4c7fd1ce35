#include "emulators/cia402/emulated_drives.hpp"

#include <algorithm>
#include <utility>

namespace trivela::hal::cia402 {
namespace {

std::vector<std::string> encoded(const EmulatedDrive::Frames& frames) {
  std::vector<std::string> said;
  for (const can::Frame& frame : frames) said.push_back(can::encode(frame));
  return said;
}

}  // namespace

EmulatedDrives::EmulatedDrives(std::uint8_t count) {
  for (std::uint8_t node = 1; node <= count; ++node) drives_.emplace_back(node);
}

std::vector<std::string> EmulatedDrives::take(std::string_view bytes, std::int64_t now_ns) {
  EmulatedDrive::Frames out;
  for (const can::Frame& frame : can::decode(bytes)) {
    if (recording) taken_.push_back(frame);
    for (EmulatedDrive& drive : drives_) drive.take(frame, now_ns, out);
  }
  return encoded(out);
}

std::vector<std::string> EmulatedDrives::tick(std::int64_t now_ns) {
  EmulatedDrive::Frames out = std::exchange(to_say_, {});
  for (EmulatedDrive& drive : drives_) drive.tick(now_ns, out);
  return encoded(out);
}

std::int64_t EmulatedDrives::next_ns() const {
  if (!to_say_.empty()) return 0;
  std::int64_t next_ns = kNever_ns;
  for (const EmulatedDrive& drive : drives_) next_ns = std::min(next_ns, drive.next_ns());
  return next_ns;
}

}  // namespace trivela::hal::cia402
