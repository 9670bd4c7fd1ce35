#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/line/line.hpp"

namespace trivela::hal {

/// "no such file or directory" of an errno.
std::string system_error(int error);

/// Why a line does not open whose device has a host already.
inline constexpr const char* kTaken = "another program has it";

/// Owns a non-blocking file descriptor, of a terminal or a socket, or none (-1).
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void reset(int fd = -1) noexcept;
  int release() noexcept;

  /// Waits for `events` of poll(2). What happened; 0: nothing in time.
  short wait(short events, Line::Deadline deadline) const;

  /// As Line::read() and Line::write(). A peer that is gone raises no signal.
  std::optional<std::size_t> read(std::span<char> bytes, Line::Deadline deadline, std::string& why) const;
  bool write(std::string_view bytes, Line::Deadline deadline, std::string& why) const;

 private:
  int fd_ = -1;
};

}  // namespace trivela::hal
