#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/session.hpp"

namespace trivela::log {

/// What an experiment was asked for.
struct Experiment {
  std::string arguments;     ///< everything that its rows depend on, as text
  std::int64_t matches = 0;  ///< of each arm
};

inline constexpr std::uint32_t kMostArms = 128;  ///< of an experiment

/// The UUID of a session of an experiment, version 8 (RFC 9562): of the arguments' SHA-256 (64 hexadecimal digits), the
/// match (below 2^20) and the arm (below kMostArms) alone. Sessions of one experiment have keys that rise with the
/// match, then with the arm.
std::string experiment_uuid(std::string_view arguments_sha256, std::uint32_t match_id, std::uint32_t arm);

/// Cells of a row, in the order of the columns of its table.
class RowSink {
 public:
  virtual ~RowSink() = default;
  virtual void integer(std::int64_t value) = 0;
  virtual void number(double value) = 0;     ///< NaN: NULL
  virtual void text(const char* value) = 0;  ///< must live until the row's end
};

/// A match log of many simulated sessions, match by match: a match is in the file whole or not at all, also when the
/// program is killed. The same rows make the same tables, however often the run was stopped. For one thread at a time.
class ExperimentLog {
 public:
  /// Makes the log, or goes on with it. Throws std::runtime_error naming the path where it cannot be written, holds
  /// something else, or was begun with other arguments.
  ExperimentLog(const std::filesystem::path& path, const Experiment& experiment);
  ~ExperimentLog();
  ExperimentLog(const ExperimentLog&) = delete;
  ExperimentLog& operator=(const ExperimentLog&) = delete;

  /// Matches that were written, by commit() at the latest in the file: 0, 1, ... up to this one.
  std::int64_t matches_done() const { return matches_done_; }

  /// Registers rows of a table; returns its number. Throws std::runtime_error naming what the schema does not have.
  std::size_t table(std::string_view name, const std::vector<std::string>& columns);

  /// Begins the next match, unless one has begun. What is inserted until end_match() belongs to it.
  void begin();

  /// A session that has ended; its key for the rows.
  std::int64_t add_session(const Session& session, std::int64_t closed_t_ns);

  /// The cells of the next row of a table; end_row() inserts it.
  RowSink& row(std::size_t table, std::int64_t session_id);

  /// Throws std::runtime_error where a cell lacks or is of another type, a label is none of the schema's, the key is
  /// there, or the disk refuses.
  void end_row();

  /// The match is written, but in the file only where the last commit() was some tenths of a second ago: a commit costs
  /// more than a short match.
  void end_match();

  /// What was written is in the file. Throws std::runtime_error where the disk refuses.
  void commit();

  /// All matches are there: folds the write-ahead log into the one file, if no reader holds it.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::int64_t matches_done_ = 0;
};

}  // namespace trivela::log
