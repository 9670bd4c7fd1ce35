#include "log/schema/row_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "log/schema/bind.hpp"

namespace trivela::log {
namespace {

constexpr std::int64_t kToldEvery_rows = 10'000;
constexpr std::size_t kPour_B = 1 << 16;

}  // namespace

const std::vector<StreamTable>& digested_tables() {
  static const std::vector<StreamTable> tables = [] {
    std::vector<StreamTable> digested = stream_tables();
    std::erase_if(digested, [](const StreamTable& table) {
      return std::ranges::count(kSaidAfterwards, table.name) + std::ranges::count(kTallies, table.name) > 0;
    });
    return digested;
  }();
  return tables;
}

RowDigests::RowDigests(SQLite::Database& database) : database_(database) {
  for (const StreamTable& table : digested_tables()) {
    const std::string sql =
        fmt::format("SELECT * FROM main.{} WHERE session_id = ? ORDER BY {}", table.name, table.key);
    sqlite3_stmt* select = nullptr;
    const int code =
        sqlite3_prepare_v3(database.getHandle(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &select, nullptr);
    if (code != SQLITE_OK) throw SQLite::Exception(database.getHandle(), code);
    Rows& rows = tables_.emplace_back();
    rows.select.reset(select);
    rows.head = fmt::format("table {}", table.name);
    rows.columns = sqlite3_column_count(select);
    for (int i = 0; i < rows.columns; ++i) rows.head += fmt::format(" {}", sqlite3_column_name(select, i));
    rows.head += '\n';
  }
}

void RowDigests::pour() {
  sha256_.add(bytes_);
  bytes_.clear();
}

void RowDigests::add_text(std::string_view text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }

void RowDigests::add_number(unsigned char tag, std::uint64_t bits) {
  std::array<unsigned char, 9> bytes{tag};
  for (std::size_t i = 0; i < 8; ++i) bytes[i + 1] = static_cast<unsigned char>(bits >> (56 - 8 * i));
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void RowDigests::add_cell(sqlite3_value* cell) {
  switch (sqlite3_value_type(cell)) {
    case SQLITE_INTEGER:
      return add_number('i', static_cast<std::uint64_t>(sqlite3_value_int64(cell)));
    case SQLITE_FLOAT:
      return add_number('f', std::bit_cast<std::uint64_t>(sqlite3_value_double(cell)));
    case SQLITE_TEXT: {
      const auto* const text = reinterpret_cast<const char*>(sqlite3_value_text(cell));
      const std::string_view whole(text, static_cast<std::size_t>(sqlite3_value_bytes(cell)));
      add_number('t', whole.size());
      return add_text(whole);
    }
    case SQLITE_BLOB: {
      const auto* const blob = static_cast<const char*>(sqlite3_value_blob(cell));
      const std::string_view whole(blob, static_cast<std::size_t>(sqlite3_value_bytes(cell)));
      add_number('b', whole.size());
      return add_text(whole);
    }
    default:
      bytes_.push_back('n');
  }
}

RowDigest RowDigests::of(std::int64_t session_id) {
  RowDigest digest;
  bytes_.clear();
  add_text(fmt::format("trivela match log {}\n", kMatchLog.version));
  for (const Rows& rows : tables_) {
    add_text(rows.head);
    sqlite3_stmt* const row = rows.select.get();
    sqlite3_bind_int64(row, 1, session_id);
    int code = SQLITE_OK;
    while ((code = sqlite3_step(row)) == SQLITE_ROW) {
      if (++digest.row_count % kToldEvery_rows == 0 && told_) told_(digest.row_count);
      bytes_.push_back('r');
      for (int i = 0; i < rows.columns; ++i) add_cell(sqlite3_column_value(row, i));  // no other thread has the row
      if (bytes_.size() >= kPour_B) pour();
    }
    sqlite3_reset(row);
    if (code != SQLITE_DONE) {
      sha256_.finish();  // begins again
      throw SQLite::Exception(database_.getHandle(), code);
    }
  }
  pour();
  digest.sha256 = sha256_.finish();
  return digest;
}

void RowDigests::write(std::int64_t session_id) {
  const RowDigest digest = of(session_id);
  run(database_, "INSERT OR REPLACE INTO main.digests (session_id, row_count, sha256) VALUES (?, ?, ?)", session_id,
      digest.row_count, digest.sha256);
}

}  // namespace trivela::log
