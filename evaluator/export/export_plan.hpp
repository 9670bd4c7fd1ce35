#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "log/read/reader.hpp"
#include "log/read/stream_table.hpp"

namespace trivela::evaluator {

/// What of a log is asked for cannot be exported as it was asked.
struct BadExport : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What is exported of a log.
struct ExportPlan {
  std::vector<std::string> streams;   ///< names of tables; none: all
  std::vector<std::string> sessions;  ///< beginnings of uuids; none: all
};

/// Told the rows so far, now and then; false: stop, nothing is kept.
using ExportProgress = std::function<bool(std::int64_t rows)>;

/// Thrown where ExportProgress says so.
struct ExportStopped {};

/// Counts rows and asks whether to go on.
class ExportPace {
 public:
  explicit ExportPace(const ExportProgress& progress) : progress_(progress) {}
  void row() {
    constexpr std::int64_t kAskedEvery = 4096;
    if (++rows_ % kAskedEvery == 0 && progress_ && !progress_(rows_)) throw ExportStopped{};
  }
  std::int64_t rows() const { return rows_; }

 private:
  const ExportProgress& progress_;
  std::int64_t rows_ = 0;
};

/// While it lives, everything that is read of a log is of one instant: it may grow meanwhile.
class Snapshot {
 public:
  explicit Snapshot(const log::Reader& reader) : reader_(reader) {
    reader_.query("BEGIN", [](auto) {});
  }
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;
  ~Snapshot();

 private:
  const log::Reader& reader_;
};

/// Rows by stream, of those that have any.
using ExportedRows = std::map<std::string, std::int64_t>;

/// The tables that the plan names, in the order of the schema. Throws BadExport naming one that is none.
std::vector<log::StreamTable> tables_of(const ExportPlan& plan);

/// The sessions that the plan names. Throws BadExport naming a beginning that none has.
std::vector<log::RecordedSession> sessions_of(const ExportPlan& plan, const log::Reader& reader);

/// " WHERE session_id IN (...)" of the plan's sessions; empty where it names none.
std::string only_sessions(const ExportPlan& plan, const log::Reader& reader);

/// How many rows that is, for a progress bar: it reads all of them.
std::int64_t count_rows(const ExportPlan& plan, const log::Reader& reader);

}  // namespace trivela::evaluator
