#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string_view>

namespace trivela::bus {

/// The bus cannot go on: names the call, the topic or thing, and the reason.
class Error : public std::runtime_error {
 public:
  Error(std::string_view call, std::string_view about, std::string_view reason);
};

/// Throws Error with Cyclone's text of a negative result.
[[noreturn]] void refuse(std::int32_t result, std::string_view call, std::string_view about);

/// Returns a result of Cyclone's API as it is, or throws as refuse() does if it is negative.
inline std::int32_t checked(std::int32_t result, std::string_view call, std::string_view about) {
  if (result < 0) refuse(result, call, about);
  return result;
}

/// Owns one handle of Cyclone's; deleted with its owner. 0: none.
class Entity {
 public:
  Entity() = default;
  explicit Entity(std::int32_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(other.release()) {}
  Entity& operator=(Entity&& other) noexcept;
  ~Entity() { reset(); }

  std::int32_t handle() const { return handle_; }
  void reset() noexcept;

 private:
  std::int32_t release() noexcept;

  std::int32_t handle_ = 0;
};

/// While it lives, the lines that Cyclone would write to standard error go to `line` instead. One at a time in a
/// process.
class LibraryLog {
 public:
  /// line(severe, text) is called on any thread, for a line after the other; it must not use the bus.
  explicit LibraryLog(std::function<void(bool severe, std::string_view text)> line);
  LibraryLog(const LibraryLog&) = delete;
  LibraryLog& operator=(const LibraryLog&) = delete;
  ~LibraryLog();

 private:
  std::function<void(bool severe, std::string_view text)> line_;
};

}  // namespace trivela::bus
