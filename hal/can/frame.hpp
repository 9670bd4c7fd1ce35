#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::hal::can {

/// One frame of a classic CAN bus.
struct Frame {
  std::uint32_t id = 0;   ///< 29 bits where it is extended, else 11
  bool extended = false;  ///< a 29-bit identifier
  bool error = false;     ///< no frame of the bus: what the interface says of itself, `id` is of linux/can/error.h
  std::uint8_t size = 0;  ///< of the data, up to 8
  std::array<std::uint8_t, 8> data{};

  /// The bytes that it carries.
  std::span<const std::uint8_t> payload() const { return {data.data(), size}; }
  bool operator==(const Frame&) const = default;
};

/// A frame with an 11-bit identifier.
Frame standard_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data);

/// A frame with a 29-bit identifier.
Frame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data);

/// As the kernel has it, struct can_frame, which is what a can_line() carries: one of them by a write and by a read.
std::string encode(const Frame& frame);

/// The frames of what was read; what is not a whole number of them, or claims more than eight bytes, is left out.
std::vector<Frame> decode(std::string_view bytes);

/// What an error frame says, in words: "bus off", "no acknowledgement".
std::string describe_error(const Frame& frame);

/// The controller has left the bus.
bool is_bus_off(const Frame& frame);

}  // namespace trivela::hal::can
