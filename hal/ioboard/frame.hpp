#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The serial protocol of the Falcons' ioBoard: the host asks, the board answers, frames of 11 bytes
///
///     5A | command | payload[8] | sum        sum = ones' complement of the sum of command and payload
///
/// Source: Falcons-Robocup/code, peripherals/ioBoard/{include/config.h,include/Package.h,src/Package.c,src/main.c}.
namespace trivela::hal::ioboard {

enum class Command : std::uint8_t {
  kShoot = 0x02,    ///< payload[0]: pulse in units of kPulseUnit_us
  kHeight = 0x07,   ///< payload[0]: lever, 0 home, else its position up to 205
  kStatus = 0x08,   ///< answer: [0] in-play switch, [1] software-on switch
  kVersion = 0x56,  ///< answer: eight characters; of the emulated board kEmulatedVersion
  kUnknown = 0xFF,  ///< answer: the board does not know the command
};

inline constexpr double kPulseUnit_us = 128.0;
inline constexpr std::string_view kEmulatedVersion = "emulated";

using Payload = std::array<std::uint8_t, 8>;

struct Frame {
  Command command = Command::kUnknown;
  Payload payload{};
  bool operator==(const Frame&) const = default;
};

/// The frame of a command of one byte.
Frame frame_of(Command command, std::uint8_t value = 0);

/// The 11 bytes.
std::string encode(const Frame& frame);

/// Frames out of bytes as they come, in any pieces. Bytes that belong to no frame, and frames with a wrong sum, are
/// passed over and counted; the next 5A may stand inside of what was passed over.
class FrameParser {
 public:
  /// The frames that are whole by now.
  std::vector<Frame> feed(std::string_view bytes);

  /// Bytes that were passed over, in all.
  std::uint64_t stray_bytes() const { return stray_bytes_; }
  /// Frames with a wrong sum, in all.
  std::uint64_t wrong_sums() const { return wrong_sums_; }

 private:
  std::string bytes_;  // not yet a frame; begins with 5A or is empty
  std::uint64_t stray_bytes_ = 0;
  std::uint64_t wrong_sums_ = 0;
};

}  // namespace trivela::hal::ioboard
