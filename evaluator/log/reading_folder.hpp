#pragma once

#include <filesystem>

namespace trivela::evaluator::log {

/// A private temporary folder for copies that are read. It goes with this; what a killed program left goes with the
/// next one that any program of the same user makes.
class ReadingFolder {
 public:
  /// Throws std::system_error where no folder can be made.
  ReadingFolder();
  ~ReadingFolder();
  ReadingFolder(const ReadingFolder&) = delete;
  ReadingFolder& operator=(const ReadingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int held_ = -1;  // descriptor whose lock says that somebody reads here
};

}  // namespace trivela::evaluator::log
