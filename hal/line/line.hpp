#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trivela::hal {

/// A two-way line of bytes to a device. One thread at a time; every call returns by its deadline.
class Line {
 public:
  using Deadline = std::chrono::steady_clock::time_point;
  enum class Opening {
    kOpen,
    kPending,  ///< call open() again
    kFailed,   ///< why() says it
  };

  virtual ~Line() = default;

  /// Opens it, or goes on with opening it.
  virtual Opening open(Deadline deadline) = 0;

  /// Waits for bytes: how many came; 0: none in time; none: the line dropped, why() says it.
  virtual std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) = 0;

  /// Sends all of them. False: it could not, why() says it; some may have left.
  virtual bool write(std::string_view bytes, Deadline deadline) = 0;

  /// Bytes of write() that the other side has not acknowledged; 0 also where the line cannot tell.
  virtual std::size_t unacknowledged_bytes() const { return 0; }

  /// What was written and has not left yet is not sent, where the system can take it back: a serial device whose
  /// driver flushes can, TCP and a pseudo-terminal cannot.
  virtual void drop_unsent() noexcept {}

  virtual void close() noexcept = 0;

  /// To wait for it together with something else; -1: closed.
  virtual int descriptor() const = 0;

  /// "/dev/ttyACM0", "tcp://192.168.0.10:10940".
  virtual const std::string& name() const = 0;
  /// The last failure, as a clause: "no such file or directory".
  virtual const std::string& why() const = 0;
};

/// The serial device at `path`, raw, 8 bits, no parity, no flow control, 115200 baud where it has a speed (a USB
/// scanner has none). While it is open no other serial_line() opens the device, in any program (flock).
std::unique_ptr<Line> serial_line(const std::string& path);

/// A TCP connection; `host` is a name or an address.
std::unique_ptr<Line> tcp_line(const std::string& host, std::uint16_t port);

}  // namespace trivela::hal
