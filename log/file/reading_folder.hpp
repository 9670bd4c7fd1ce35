#pragma once

#include <filesystem>

namespace trivela::log {

/// A private temporary folder for copies that are read. The destructor removes it. A killed program leaves its folder;
/// the next constructor, in any program of the same user, removes that once it is a minute old.
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
  int held_ = -1;  // descriptor of the lock: somebody reads here
};

}  // namespace trivela::log
