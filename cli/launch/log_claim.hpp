#pragma once

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "cli/verbs.hpp"

namespace trivela::cli {

/// Makes sure that the recorder can make a log of that name, and leaves no trace of it, even where this process is
/// killed. A log in which nothing was recorded is gone with the object.
class LogClaim {
 public:
  /// Throws UsageError where the file exists, std::runtime_error where it cannot be made.
  explicit LogClaim(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code unknown;
    if (std::filesystem::exists(std::filesystem::symlink_status(path_, unknown))) refuse_existing();
    const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
    if (!std::filesystem::exists(folder, unknown) && !unknown)
      throw std::runtime_error{
          fmt::format("cannot write --out {}: there is no folder {}", path_.string(), folder.string())};
    int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644);
    if (descriptor < 0) {  // also where the file system has no files without a name
      descriptor = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
      const int reason = errno;
      if (descriptor < 0 && reason == EEXIST) refuse_existing();
      if (descriptor < 0)
        throw std::runtime_error{fmt::format("cannot write --out {}: {}", path_.string(), std::strerror(reason))};
      unlink(path_.c_str());
    }
    close(descriptor);
  }
  LogClaim(const LogClaim&) = delete;
  LogClaim& operator=(const LogClaim&) = delete;
  ~LogClaim() {
    std::error_code ignored;
    if (std::filesystem::file_size(path_, ignored) == 0) std::filesystem::remove(path_, ignored);
  }

  /// Whether the recorder has written to it.
  bool recorded() const {
    std::error_code gone;
    const auto size = std::filesystem::file_size(path_, gone);
    return !gone && size > 0;
  }

 private:
  [[noreturn]] void refuse_existing() const {
    throw UsageError{
        fmt::format("--out {} exists already; a recorded match is never overwritten, choose another", path_.string())};
  }

  std::filesystem::path path_;
};

}  // namespace trivela::cli
