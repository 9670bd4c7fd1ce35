#include "evaluator/log/log_file.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <stdexcept>

namespace trivela::evaluator::log {
namespace {

namespace fs = std::filesystem;

// Opens and checks; SQLite's own words follow ours.
std::unique_ptr<SQLite::Database> open(const fs::path& path, const LogKind& kind) {
  if (!fs::is_regular_file(path)) {
    throw std::runtime_error(fmt::format("there is no {} {}", kind.name, path.string()));
  }
  try {
    auto database = std::make_unique<SQLite::Database>(path.string(), SQLite::OPEN_READONLY, 5000);
    database->exec("PRAGMA trusted_schema = OFF; PRAGMA temp_store = MEMORY;");
    const int application_id = database->execAndGet("PRAGMA application_id").getInt();
    const int version = database->execAndGet("PRAGMA user_version").getInt();
    for (const LogKind& other : {kMatchLog, kScanRecord}) {
      if (application_id != other.application_id || application_id == kind.application_id) continue;
      throw std::runtime_error(fmt::format("{} is not a {} but a {}", path.string(), kind.name, other.name));
    }
    if (application_id != kind.application_id || version < 1) {
      throw std::runtime_error(fmt::format("{} is not a {}", path.string(), kind.name));
    }
    if (version > kind.version) {
      throw std::runtime_error(fmt::format("{} is a {} of version {}; this program reads version {} and older",
                                           path.string(), kind.name, version, kind.version));
    }
    const std::string check = database->execAndGet("PRAGMA quick_check(1)").getString();
    if (check != "ok") {
      throw std::runtime_error(fmt::format("the {} {} is damaged: {}", kind.name, path.string(), check));
    }
    return database;
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB) {
      throw std::runtime_error(fmt::format("{} is not a {}", path.string(), kind.name));
    }
    if (error.getErrorCode() == SQLITE_CORRUPT) {
      throw std::runtime_error(fmt::format("the {} {} is damaged: {}", kind.name, path.string(), error.what()));
    }
    throw std::runtime_error(fmt::format("cannot read the {} {}: {}", kind.name, path.string(), error.what()));
  }
}

}  // namespace

Value value_of(const SQLite::Column& column) {
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isText()) return column.getString();
  if (!column.isBlob()) return std::monostate{};
  const auto* const bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return Blob(bytes, bytes + column.getBytes());
}

LogFile::LogFile(const fs::path& path, const LogKind& kind)
    : kind_(kind), path_(path.string()), has_wal_(fs::exists(path_ + "-wal")), database_(open(path, kind)) {}

int LogFile::version() const { return database_->execAndGet("PRAGMA user_version").getInt(); }

void LogFile::query(std::string_view sql, const RowFunction& fn) const {
  try {
    SQLite::Statement statement(*database_, std::string(sql));
    std::vector<Value> row(static_cast<std::size_t>(statement.getColumnCount()));
    while (statement.executeStep()) {
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = value_of(statement.getColumn(static_cast<int>(i)));
      fn(row);
    }
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(fmt::format("cannot read the {} {}: {}", kind_.name, path_, error.what()));
  }
}

std::string LogFile::not_closed() const {
  return has_wal_ ? "its recorder still runs or was killed, the last rows may be missing"
                  : "no -wal file lies beside the log, its last part may be missing";
}

}  // namespace trivela::evaluator::log
