#pragma once

#include <SQLiteCpp/Database.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "log/merge/clock_alignment.hpp"
#include "log/merge/merge_source.hpp"

namespace trivela::log {

struct MergeOptions {
  std::optional<int> reference_robot{};  ///< by whose clock times are aligned, 0: the base's; none: chosen
  /// Told the rows read so far, and how many the files say that they have, the first time before `to` is made; false:
  /// stop, nothing is kept. None: nobody asks.
  std::function<bool(std::int64_t read, std::int64_t all)> progress{};
  std::function<void(SQLite::Database&)> finish{};  ///< called with all rows, before they are committed; none: nothing
};

/// A session as one file had it.
struct MergedPart {
  std::int64_t session_id = 0;
  std::int64_t rows = 0;   ///< that could be read
  std::int64_t added = 0;  ///< of those no file before it had
};

/// A file that was asked to be merged.
struct MergedFile {
  std::filesystem::path path;
  std::string damage;             ///< what is wrong with it; empty: nothing
  bool readable = true;           ///< false: nothing of it was taken
  std::vector<MergedPart> parts;  ///< by session_id
};

/// A session of the new log.
struct MergedSession {
  ClockedSession clock;
  bool is_whole = false;          ///< it has ended, and has every row that was recorded
  std::int64_t missing_rows = 0;  ///< of one that is not whole: by the counters of its recorder
};

struct Merged {
  std::vector<MergedFile> files;        ///< in the order they were given
  std::vector<MergedSession> sessions;  ///< by session_id
  Alignment alignment;
  std::vector<KickConflict> conflicts;  ///< kicks of which the files say different things
};

/// One new match log out of several. Each session is in it once, row for row as it
/// was recorded: a whole copy of it is taken alone, of others what any file has of it. Rows that several recorders made
/// of one sample stay in the session of each; readers count them once (evaluator/sessions/same_match.hpp). Of a file
/// that is damaged what can be read is taken, from its tables' beginnings and from their ends; its sessions count as
/// not closed, unless another file has them whole. Times stay as they are: tables `session_clocks` says what UTC they
/// are by the reference's clock, `merged_sessions` which file had what. What people say of kicks and sessions comes
/// along from every file, tallies with whole sessions. The same files and their merged log make the same tables again.
/// No file is changed. Throws std::runtime_error where none can be read, `to` exists, or cannot be written, Stopped
/// where `options.progress` says so; nothing is left behind then.
Merged merge(const std::vector<std::filesystem::path>& from, const std::filesystem::path& to,
             const MergeOptions& options = {});

}  // namespace trivela::log
