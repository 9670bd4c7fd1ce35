#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/schema.hpp"
#include "log/schema/session.hpp"
#include "log/write/row_queue.hpp"

namespace trivela::log {

/// Counters of every stream, for any thread.
class LossCounters {
 public:
  /// Adds the counters of `delta` to its stream and returns the sum.
  Loss add(const Loss& delta) {
    const std::lock_guard lock(mutex_);
    return streams_.try_emplace(delta.stream, Loss{.stream = delta.stream}).first->second += delta;
  }

  std::vector<Loss> all() const {
    const std::lock_guard lock(mutex_);
    std::vector<Loss> losses;
    for (const auto& [stream, loss] : streams_) losses.push_back(loss);
    return losses;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Loss, std::less<>> streams_;
};

/// A log to be made: its tables hold `sessions` with session_id and closed_t_ns, and `losses`; every other has the key
/// session_id.
struct NewLog {
  LogKind kind;
  std::int64_t session_id = 0;
  std::int64_t started_t_ns = 0;
  std::function<void(SQLite::Database&)> create;  ///< makes the tables and the session's row; throws SQLite::Exception
};

/// A table that rows are inserted into.
struct RowTable {
  std::string name;
  std::vector<bool> not_null;       ///< by column of the rows
  std::optional<std::size_t> t_ns;  ///< place of the column t_ns
  std::string insert_sql;           ///< session_id is its first parameter
  bool counted = true;              ///< each row is a sample, for the counters of the stream
  bool amends = false;              ///< it changes the session's row and is none
};

/// Silences as rows (stream, robot_id, from_t_ns, to_t_ns): a later one with the same beginning replaces the earlier.
RowTable silence_rows();

/// Silences (stream, robot_id, from_t_ns) that are taken back.
RowTable withdrawn_silence_rows();

/// What turned out of the session's world (seed, scenario, paired_halves, planned_s): its row is simulated from then
/// on, and takes what is not NULL.
RowTable simulation_rows();

/// Rows that a group could not write, by stream, with the first reason of each kind.
struct GroupResult {
  std::vector<Loss> counters;  ///< received, nan_refused and rejected of each stream in the group
  std::vector<std::string> reasons;
  std::int64_t written = 0;
  std::int64_t amended = 0;  ///< of those written
};

/// The connection of one session: what the writing thread does, one group a transaction. For one thread at a time.
class SessionWriter {
 public:
  /// Creates the log; see Writer.
  SessionWriter(const std::filesystem::path& path, const NewLog& log);

  /// See Writer::table.
  RowTable describe(std::string_view name, const std::vector<std::string>& columns) const;

  /// Commits the group with the sums of `loss_counters` and the group's own counters. Throws SQLite::Exception where
  /// the disk refuses; nothing of the group is in the log then.
  GroupResult commit(const std::vector<Row>& group, const std::deque<RowTable>& tables,
                     const LossCounters& loss_counters);

  /// Writes the counters and, with `closed_t_ns`, ends the session.
  void commit_end(const LossCounters& loss_counters, std::optional<std::int64_t> closed_t_ns);

  /// Folds the write-ahead log into the file. False: a reader holds it, so that it stays beside the file.
  bool fold();

  /// The file that the rows go to is not at its path any more: somebody deleted or renamed it.
  bool moved() const;

  /// Writes everything to the path again, or beside it where another file is there now. Returns where.
  std::filesystem::path write_again();

  const LogKind& kind() const { return kind_; }
  std::int64_t session_id() const { return session_id_; }
  std::int64_t latest_t_ns() const { return latest_t_ns_; }

 private:
  enum class Fate { kWritten, kNan, kRejected };
  Fate insert(const Row& row, const RowTable& table, SQLite::Statement& statement);
  void write_losses(const std::vector<Loss>& losses, std::int64_t latest_t_ns);

  LogKind kind_;
  std::filesystem::path path_;
  std::unique_ptr<SQLite::Database> database_;
  std::map<std::string, std::vector<Column>, std::less<>> schema_;  // by table
  std::vector<std::unique_ptr<SQLite::Statement>> statements_;      // by table
  std::int64_t session_id_;
  std::int64_t started_t_ns_;
  std::int64_t latest_t_ns_;
};

}  // namespace trivela::log
