#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "log/read/reader.hpp"
#include "log/schema/stream_table.hpp"

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

/// A cell as CSV (RFC 4180): a number as the shortest decimal that is read back to the same bits, NULL as nothing, the
/// empty text as "" in quotes, so that the two differ, another text as csv_text().
void append_csv_cell(std::string& line, const log::Value& cell);

/// Writes STREAM.csv into a new folder for each stream that has rows: names of the columns, which say the units, then
/// the rows by session, robot and number. In memory is one piece of a file. Throws BadExport as tables_of() and
/// sessions_of(), ExportStopped, std::runtime_error naming what cannot be read or written.
ExportedRows export_csv(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& folder,
                        const ExportProgress& progress = {});

/// Sessions that one MCAP file may have: they lie on one axis of time and are read at once.
inline constexpr std::size_t kMostSessionsOfMcap = 64;

/// Writes the log as MCAP in the order of time, by UTC as merging found it out: each row as a message of its own type
/// (evaluator/mcap/messages.hpp) on /robot_N/STREAM, or /log/STREAM where it is no robot's, and each session's
/// configuration as metadata. Rows without an instant stand at their session's begin. Where two sessions have rows of
/// one robot at one time, topics begin with /session_UUID. The same log and `library` (who writes) make the same bytes.
/// Beside the rows is the scene for a 3D view: standard messages of ROS in the frame "field" (F: x to the right, y to
/// the opponents' goal). A robot's frame is that of REP 103, x forward, y to the left: its yaw is the heading and a
/// quarter turn. Topics of a robot: `pose`, `ball`, `alignment` (both segments), `crossings`; `tf` and `field` of all.
/// Throws as export_csv(), BadExport where there are more sessions than kMostSessionsOfMcap.
ExportedRows export_mcap(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& file,
                         const std::string& library, const ExportProgress& progress = {});

/// A file or folder that is written beside its place, as NAME.PID.new, and gets its name when it is whole: who is
/// stopped leaves nothing by that name, and who is killed leaves the draft.
class Draft {
 public:
  explicit Draft(const std::filesystem::path& place);
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft();

  const std::filesystem::path& path() const { return draft_; }

  /// Gives it its name. A file takes the place of one that is there; the files of a folder take their places in one
  /// that is there, one after the other. Throws std::runtime_error naming the place.
  void keep();

 private:
  std::filesystem::path place_, draft_;
};

}  // namespace trivela::evaluator
