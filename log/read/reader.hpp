#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/file/files_beside.hpp"
#include "log/file/log_check.hpp"
#include "log/schema/queries.hpp"
#include "log/schema/session.hpp"

namespace trivela::log {

/// A session as it stands in a log.
struct RecordedSession : Session {
  std::int64_t session_id = 0;
  std::optional<std::int64_t> closed_t_ns;  ///< none: never finalised
  std::string config_sha256;
  std::string idl_sha256;
};

/// What a robot or the simulator says about the end of a kick.
struct RecordedOutcome {
  std::string outcome;              ///< label, e.g. "on_target"
  std::optional<double> x_cross_m;  ///< ball centre at the goal line, in F
  std::optional<double> z_cross_m;
};

/// A decision that fired with what followed it (view `kicks`).
struct Kick {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;
  int half = 0;
  std::int64_t possession_id = 0;
  std::string policy;
  bool ordered = false;                     ///< an order is in the log
  std::optional<bool> accepted;             ///< none: no receipt
  std::string refusal;                      ///< label of the receipt; empty: no receipt
  std::optional<RecordedOutcome> observed;  ///< latest outcome
  std::optional<double> sd_cross_m;         ///< of the observed crossing
  std::optional<RecordedOutcome> truth;     ///< of the simulator
  std::optional<double> truth_margin_m;     ///< true crossing to the nearest edge of another outcome
};

/// A kick as a recording has it.
struct RecordedKick {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t kick_id = 0;
};

/// A row of table labels, with the uuid of its session.
struct GivenLabel {
  std::string uuid;
  int robot_id = 0;
  std::int64_t kick_id = 0, utc_ns = 0;
  std::string who;
  std::int64_t t_ns = 0;
  std::optional<std::string> outcome;
  std::string note;
};

/// Part of a robot's stream.
struct StreamSpan {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t from_t_ns = 0;
  std::int64_t to_t_ns = 0;
};

/// A part of a table that is in order by itself.
struct TimedPart {
  std::string table;
  std::vector<std::string> columns;
  std::string key;  ///< of the table
  std::int64_t session_id = 0;
  std::optional<int> robot_id;  ///< none: rows of all
};

/// The instant of a row of a part, by one clock for all.
using PartInstant = std::function<std::int64_t(std::size_t part, std::span<const Value> row)>;

/// Called with the part, its row and the row's instant.
using PartRow = std::function<void(std::size_t part, std::int64_t t_ns, std::span<const Value> row)>;

/// Reads a match log and never changes it; a log whose recorder was killed opens too.
class Reader final : public Queries {
 public:
  /// Throws std::runtime_error naming the path where it does not exist, is no match log, is of another version, has
  /// another schema, holds texts that are not those it names, or is otherwise damaged; as far as
  /// `check` goes, also where its rows are not those that were recorded.
  explicit Reader(const std::filesystem::path& path, Check check = Check::kIfShort);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const Verification& verification() const;

  /// Whether the session has ended and its rows are those of its digest.
  bool is_whole(std::int64_t session_id) const;

  /// A sentence on what was not verified of the rows, and why; none: they are as they were recorded.
  std::optional<std::string> doubt() const;

  /// What lies beside the log.
  Wal wal() const;

  /// What it means for this file that a session has no end.
  std::string not_closed() const;

  /// Sentences on sessions that were not closed and on rows that were lost.
  std::vector<std::string> warnings() const;

  /// Without their long texts, which thousands of sessions may share.
  std::vector<RecordedSession> sessions() const;

  /// The session with its configuration and the definition of its messages.
  RecordedSession whole(RecordedSession session) const;

  /// Every kick by session and time.
  std::vector<Kick> kicks() const;

  /// Counters by stream, summed over the sessions.
  std::vector<Loss> losses() const;

  /// The rows of one robot's stream, a table with session_id, robot_id, seq and t_ns, from one instant to another, both
  /// included, by seq. They are found by halving, since t_ns rises with seq: a long log is not walked through. Throws
  /// std::runtime_error naming a table or column that does not exist.
  void for_each_row_between(std::string_view table, const std::vector<std::string>& columns, const StreamSpan& span,
                            const RowFunction& fn) const;

  /// Calls `fn` for the rows of all parts, the earliest of those that come next in their parts first, of one instant
  /// the first part's. In memory is one row of each part. Throws std::runtime_error naming the file, and what `instant`
  /// and `fn` throw.
  void for_each_row_in_time(const std::vector<TimedPart>& parts, const PartInstant& instant, const PartRow& fn) const;

  /// The robots that a session has rows of in a table of robots' streams, without walking through it.
  std::vector<int> robots_in(std::string_view table, std::int64_t session_id) const;

  /// Somebody's own question about tables, their views and counted_kicks: `head` is called once with the names of its
  /// columns, then `fn` for each row. Throws BadQuestion where it is not one SELECT, or asks for what is not there.
  void ask(const std::string& sql, const HeadFunction& head, const RowFunction& fn) const;

  /// From now on every question about kicks is answered out of memory, where there are not too many for that, with the
  /// same answers: putting each together takes five looks into the file.
  void hold_kicks() const;

  /// The rows of table labels.
  std::vector<GivenLabel> labels() const;

  /// From now on these count like the log's own, where it has their session.
  void read_labels(const std::vector<GivenLabel>& labels);

  /// From now on the view counted_kicks of this reader has neither kicks of these sessions nor these kicks.
  void leave_out(const std::vector<std::int64_t>& session_ids, const std::vector<RecordedKick>& kicks);

 private:
  struct Impl;
  void each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const override;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::log
