#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace trivela::evaluator::log {

/// Of a migration.
struct Migrated {
  int from_version = 0;
  std::int64_t rows = 0;      ///< recorded ones
  std::int64_t sessions = 0;  ///< that have a new digest: those that had ended
};

/// Copies a match log of any version to a new one of kMatchLog.version, with a new digest for each session that had
/// ended. The old log is verified first, and never changed; what the old version did not have is empty, NULL or what
/// was true then. Tables of somebody else do not come along. `progress` is told the rows so far, and all, the first
/// time before `to` is made; false: stop. Throws std::runtime_error as Reader does, and where `to` exists or cannot be
/// written, Stopped where `progress` says so: nothing is left behind then.
Migrated migrate(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<bool(std::int64_t, std::int64_t)>& progress);

/// Puts a log of this version in the place of an older one: `backup` is the old file under its new name, beside it
/// (backup_of()). The new log is made and verified before it takes the name, so that at any instant the name stands for
/// the one or the other, whole. Throws std::runtime_error where the log is of this version already, where its recorder
/// or a reader still has it, where the backup exists, and as migrate(): the log is as it was then.
Migrated migrate_in_place(const std::filesystem::path& log, const std::filesystem::path& backup,
                          const std::function<bool(std::int64_t, std::int64_t)>& progress);

/// "match.version-7.db" of "match.db", for the log's own version. Throws std::runtime_error as Reader does.
std::filesystem::path backup_of(const std::filesystem::path& log);

}  // namespace trivela::evaluator::log
