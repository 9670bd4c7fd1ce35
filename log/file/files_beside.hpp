#pragma once

#include <filesystem>
#include <optional>
#include <string>

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

/// What lies beside a log as its write-ahead log. An empty one is none.
enum class Wal {
  kNone,
  kOfThis,    ///< of a recorder that runs or was killed
  kOfAnother  ///< left over from another recording, or an older copy: not to be read with this log
};
Wal wal_beside(const std::filesystem::path& log);

/// Throws std::runtime_error where a file is to be written that has another recording's write-ahead log beside it:
/// SQLite would write that into it.
void refuse_wal_of_another(const std::filesystem::path& log, Wal wal);

/// The name by which SQLite (OPEN_URI) reads a log that nobody writes, without a file beside it: its main file alone.
std::string name_of_main_file(const std::filesystem::path& log);

/// A log as SQLite can read it and leave nothing beside it: the file alone, or with the write-ahead log of a recorder
/// that runs or was killed. Where that cannot be done in its folder, which may be read only, both are copied to a
/// temporary folder while this lives.
class ReadableLog {
 public:
  /// Throws std::runtime_error where the copy cannot be made.
  explicit ReadableLog(const std::filesystem::path& log);
  ReadableLog(const ReadableLog&) = delete;
  ReadableLog& operator=(const ReadableLog&) = delete;

  /// For SQLite, with OPEN_URI.
  const std::string& name() const { return name_; }
  Wal wal() const { return wal_; }

  /// The write-ahead log turned out to be of another recording: from here on the file alone.
  void leave_wal_out();

 private:
  std::filesystem::path log_;
  Wal wal_;
  std::string name_;
  std::optional<ReadingFolder> copied_to_;
};

}  // namespace trivela::log
