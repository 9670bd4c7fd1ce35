#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/line/line.hpp"

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

/// What an interface says when it has left the bus.
Frame bus_off_frame();

/// The controller has left the bus.
bool is_bus_off(const Frame& frame);

/// A CAN bus as a line: a write is one frame, and so is a read (hal/can/frame.hpp). `name` is an interface of the
/// kernel, as "can0", whose bit rate its administrator has set; or, where it has a '/', the path of a SOCK_SEQPACKET
/// socket with an emulator behind it. `host`: what it gives orders to, such as "kicker"; while the line is open no
/// other line opens as the same host of this bus, in any program. Empty: it only listens.
std::unique_ptr<Line> can_line(const std::string& name, const std::string& host = {});

}  // namespace trivela::hal::can
