#pragma once

#include <memory>
#include <string>

#include "hal/line/emulated_socket.hpp"
#include "hal/line/line.hpp"

namespace trivela::hal::can {

/// A CAN bus as a line: a write is one frame, and so is a read (hal/can/frame.hpp). `name` is an interface of the
/// kernel, as "can0", whose bit rate its administrator has set; or, where it has a '/', the path of a SOCK_SEQPACKET
/// socket with an emulator behind it.
std::unique_ptr<Line> can_line(const std::string& name);

/// The other end of such a socket: one client at a time, under a path that stays the same. Throws as
/// EmulatedSocket::plug(), naming the emulator.
std::unique_ptr<EmulatedSocket> emulated_bus(const std::string& emulator, const std::string& device);

}  // namespace trivela::hal::can
