#pragma once

#include <memory>
#include <string>

#include "emulators/line/emulated_socket.hpp"

namespace trivela::hal::can {

/// The other end of the socket that can_line() opens by its path: one client at a time, under a path that stays the
/// same. Throws as EmulatedSocket::plug(), naming the emulator.
std::unique_ptr<EmulatedSocket> emulated_bus(const std::string& emulator, const std::string& device);

}  // namespace trivela::hal::can
