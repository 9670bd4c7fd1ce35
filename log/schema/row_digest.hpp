#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/digest.hpp"
#include "log/schema/schema.hpp"
#include "log/schema/stream_table.hpp"

namespace trivela::log {

/// Tables of what is said of a session afterwards, which no digest covers: by merging, by people. Copies of a log
/// have them, too.
inline constexpr std::array<std::string_view, 4> kSaidAfterwards = {"session_clocks", "merged_sessions", "labels",
                                                                    "notes"};

/// Tables of what was counted of a session's rows when it ended, which no digest covers; copies count again.
inline constexpr std::array<std::string_view, 6> kTallies = {
    "session_tallies", "possession_tallies", "order_tallies", "referee_tallies", "ball_turns", "tallied_sessions"};

/// What is recorded of a session, in the order of the digest: the tables of the schema that have a
/// session_id, in its order. Not `digests`, not `experiments`, which changes while an experiment goes on, and neither
/// kSaidAfterwards nor kTallies. `texts` are covered by the hashes that sessions name them by. A change of these
/// tables, or of their order, is another version of the log.
const std::vector<StreamTable>& digested_tables();

struct RowDigest {
  std::int64_t row_count = 0;
  std::string sha256;
  bool operator==(const RowDigest&) const = default;
};

/// The digest of a session's rows: SHA-256 of
///   "trivela match log VERSION\n", then for each of digested_tables(), also where it has no row of the session,
///     "table NAME COLUMN COLUMN ...\n" with the columns as schema.sql has them,
///     and for each row of the session, by primary key (texts by their UTF-8 bytes): "r", then for each cell
///       NULL "n", INTEGER "i" and 8 bytes of two's complement, REAL "f" and 8 bytes of IEEE 754 binary64,
///       TEXT "t", its length in 8 bytes and its UTF-8 bytes, BLOB "b", its length in 8 bytes and its bytes.
/// Numbers of 8 bytes are big-endian. It tells whether rows are as they were written; it is no signature: who changes
/// rows on purpose can write their digest, too.
class RowDigests {
 public:
  /// Of a match log whose schema was checked. Throws SQLite::Exception.
  explicit RowDigests(SQLite::Database& database);

  /// Throws SQLite::Exception where the file cannot be read.
  RowDigest of(std::int64_t session_id);

  /// From now on `told(rows)` is called every some thousand rows of a session.
  void tell(std::function<void(std::int64_t rows)> told) { told_ = std::move(told); }

  /// Notes it in table `digests`.
  void write(std::int64_t session_id);

  /// Lets go of the database; nothing is called afterwards.
  void close() { tables_.clear(); }

 private:
  struct Finalise {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  struct Rows {
    std::string head;
    int columns = 0;
    std::unique_ptr<sqlite3_stmt, Finalise> select;
  };

  void add_text(std::string_view text);
  void add_number(unsigned char tag, std::uint64_t bits);
  void add_cell(sqlite3_value* cell);
  void pour();

  SQLite::Database& database_;
  std::vector<Rows> tables_;
  std::vector<unsigned char> bytes_;  // not hashed yet
  RunningSha256 sha256_;
  std::function<void(std::int64_t)> told_;
};

}  // namespace trivela::log
