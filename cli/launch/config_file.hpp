#pragma once

#include <fmt/core.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace trivela::cli {

/// A configuration in memory that this process and those it starts read by a name, and that is gone with the last of
/// them, however they end: no file of it is in any folder.
class ConfigFile {
 public:
  /// Throws std::runtime_error saying why it cannot be kept.
  explicit ConfigFile(const std::string& text) : descriptor_(memfd_create("trivela.toml", 0)) {
    for (std::size_t written = 0; descriptor_ >= 0 && written < text.size();) {
      const ssize_t n = write(descriptor_, text.data() + written, text.size() - written);
      if (n > 0) written += static_cast<std::size_t>(n);
      if (n <= 0 && errno != EINTR) release();
    }
    if (descriptor_ < 0)
      throw std::runtime_error{fmt::format("cannot keep the configuration for the nodes: {}", std::strerror(errno))};
  }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;
  ~ConfigFile() { release(); }

  /// The same in this process and in those that it starts while the object lives.
  std::filesystem::path path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  void release() {
    const int reason = errno;
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
    errno = reason;
  }

  int descriptor_;  // without CLOEXEC
};

}  // namespace trivela::cli
