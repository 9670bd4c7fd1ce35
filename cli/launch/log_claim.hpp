#pragma once

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "cli/verbs.hpp"

namespace trivela::cli {

/// An empty file that keeps a name for the recorder; gone with the object where nothing was recorded.
class LogClaim {
 public:
  /// Throws UsageError where the file exists, std::runtime_error where it cannot be made.
  explicit LogClaim(std::filesystem::path path) : path_(std::move(path)) {
    const int descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    const int reason = errno;
    if (descriptor >= 0) {
      close(descriptor);
    } else if (reason == EEXIST) {
      throw UsageError{fmt::format("--out {} exists already; a recorded match is never overwritten, choose another",
                                   path_.string())};
    } else {
      throw std::runtime_error{fmt::format("cannot write --out {}: {}", path_.string(), std::strerror(reason))};
    }
  }
  LogClaim(const LogClaim&) = delete;
  LogClaim& operator=(const LogClaim&) = delete;
  ~LogClaim() {
    std::error_code ignored;
    if (!recorded()) std::filesystem::remove(path_, ignored);
  }

  /// Whether the recorder has written to it.
  bool recorded() const {
    std::error_code gone;
    const auto size = std::filesystem::file_size(path_, gone);
    return !gone && size > 0;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace trivela::cli
