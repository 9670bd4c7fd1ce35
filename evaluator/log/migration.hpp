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
/// was true then. Tables of somebody else do not come along. `progress` is told the rows so far, and all. Throws
/// std::runtime_error as Reader does, and where `to` exists or cannot be written: nothing is left behind then.
Migrated migrate(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<void(std::int64_t, std::int64_t)>& progress);

}  // namespace trivela::evaluator::log
