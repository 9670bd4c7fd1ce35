#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/row.hpp"
#include "log/schema/session.hpp"

namespace trivela::log {

struct WriterOptions {
  std::size_t queue_capacity = 65536;  ///< rows that may wait for the disk
  double group_commit_s = 0.1;  ///< a row is committed at most this long after its push, with others, in one fsync
  bool warn_late = false;       ///< say it where the disk takes longer than that
  std::function<void(const std::string&)> warn;  ///< one line an event, called from any thread; none: standard error
};

struct NewLog;

/// A registered table with its columns.
struct TableId {
  std::size_t index = 0;
};

struct Stats {
  std::int64_t rows_written = 0;     ///< committed
  std::int64_t rows_missing = 0;     ///< queue full, NaN or against the schema
  std::int64_t samples_missing = 0;  ///< the same, and those that never came here
  std::int64_t commits = 0;          ///< groups of rows
  double rows_per_s = 0.0;           ///< committed rows over the wall time from the first push to the last commit
  std::size_t queue_high_water = 0;
  double oldest_row_s = 0.0;  ///< longest from a push to the end of its commit
};

/// Records one session to a new log (SQLite, WAL, synchronous FULL) from one thread of its own.
/// `push` never waits for the disk. All functions may be called from any thread, but `finalise` once and last.
class Writer {
 public:
  /// Creates a match log. Throws std::runtime_error naming the path where it cannot be created, or where it holds
  /// anything already: a recorded match is never overwritten.
  Writer(const std::filesystem::path& path, const Session& session, WriterOptions options = {});

  /// Creates a log of another kind by the same rules.
  Writer(const std::filesystem::path& path, const NewLog& log, WriterOptions options = {});

  /// Finalises where that was not done; errors go to `warn`.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::int64_t session_id() const;

  /// Registers rows of `columns` (without session_id) for the table `name`. Throws std::runtime_error naming the
  /// table or column that the schema does not have, or the column that must not be left out.
  TableId table(std::string_view name, const std::vector<std::string>& columns);

  /// Queues a row, values in the order of the columns. False: the queue is full, and the row is counted as overflow.
  /// NaN in a column that may be NULL is written as NULL. A row with NaN elsewhere, with an infinity or against the
  /// schema is left out and counted.
  bool push(TableId table, std::vector<Value> values);

  /// Adds n to a counter of the stream, which is named like its table.
  void add_loss(std::string_view stream, LossKind kind, std::int64_t n = 1);

  /// A row for a silence, written among the rows as they come; the same once more with its end replaces it.
  void silence(const Silence& silence);

  /// It was none: its row goes.
  void withdraw(const Silence& silence);

  /// The session's row says from now on that it is simulated; with a `world`, also in which. False: the queue is full.
  bool simulated(const std::optional<Simulation>& world);

  /// Waits until everything pushed so far is committed. Throws std::runtime_error where the disk refuses.
  void flush();

  /// What the disk says at present; none: all is well. Rows that it refused are kept and tried again.
  std::optional<std::string> health() const;

  Stats stats() const;

  /// Rows pushed and not committed yet.
  std::size_t waiting() const;

  /// Commits the rest and the counters, sets closed_t_ns (none: the latest t_ns recorded), and folds the write-ahead
  /// log into the one file. Throws std::runtime_error where rows could not be written; the earlier ones are kept.
  void finalise(std::optional<std::int64_t> closed_t_ns = std::nullopt);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::log
