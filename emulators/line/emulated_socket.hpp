#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "hal/line/descriptor.hpp"

namespace trivela::hal {

/// The device's end of a cable. plug() throws std::runtime_error naming what the system refuses.
class EmulatedSocket {
 public:
  virtual ~EmulatedSocket() = default;

  virtual void plug() = 0;
  virtual void pull() noexcept = 0;

  /// Becomes readable when a client waits; -1: there is none to wait for.
  virtual int listener() const = 0;
  virtual void accept() = 0;
  /// The line to the client; -1: nobody is there.
  virtual int client() const = 0;
  /// The client is gone.
  virtual void hang_up() noexcept = 0;

  virtual const std::string& address() const = 0;
};

/// A pseudo-terminal under a path that stays the same: trivela-EMULATOR-XXXXXX/DEVICE in the folder for temporary
/// files. Throws as plug(), naming the emulator.
std::unique_ptr<EmulatedSocket> emulated_terminal(const std::string& emulator, const std::string& device);

/// The other end of the socket that can_line() opens by its path: under such a path, one client at a time.
std::unique_ptr<EmulatedSocket> emulated_bus(const std::string& emulator, const std::string& device);

/// A port of the loopback interface, 0: any; it stays the same over pull() and plug(). Throws as plug(), naming the
/// emulator.
std::unique_ptr<EmulatedSocket> emulated_tcp(const std::string& emulator, std::uint16_t port);

}  // namespace trivela::hal
