#pragma once

#include <functional>
#include <string_view>

namespace trivela::bus {

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
