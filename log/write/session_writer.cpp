#include "log/write/session_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "log/file/new_file.hpp"
#include "log/file/session_tallies.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {
SessionWriter::SessionWriter(const std::filesystem::path& path, const NewLog& log)
    : kind_(log.kind),
      path_(path),
      database_(new_file(path, log.kind, log.create)),
      session_id_(log.session_id),
      started_t_ns_(log.started_t_ns),
      latest_t_ns_(log.started_t_ns) {
  for (const std::string& table : tables_of(*database_)) schema_[table] = *columns_of(*database_, table);
}

RowTable SessionWriter::describe(std::string_view name, const std::vector<std::string>& columns) const {
  const auto schema = schema_.find(name);
  if (schema == schema_.end()) throw std::runtime_error(fmt::format("the {} has no table '{}'", kind_.name, name));
  RowTable table{.name = std::string(name), .not_null = {}, .t_ns = {}, .insert_sql = {}};
  for (const std::string& column : columns) {
    const auto found = std::ranges::find(schema->second, column, &Column::name);
    if (found == schema->second.end() || column == "session_id") {
      throw std::runtime_error(
          fmt::format("table '{}' of the {} has no column '{}' to fill", name, kind_.name, column));
    }
    if (column == "t_ns") table.t_ns = table.not_null.size();
    table.not_null.push_back(found->not_null);
  }
  for (const Column& column : schema->second) {
    const bool needed = column.not_null && !column.has_default && column.name != "session_id";
    if (needed && std::ranges::find(columns, column.name) == columns.end()) {
      throw std::runtime_error(fmt::format("column '{}' of table '{}' must not be left out", column.name, name));
    }
  }
  table.insert_sql = fmt::format("INSERT INTO {} (session_id, {}) VALUES (?", name, fmt::join(columns, ", "));
  for (std::size_t i = 0; i < columns.size(); ++i) table.insert_sql += ", ?";
  table.insert_sql += ")";
  return table;
}

RowTable silence_rows() {
  return {.name = "losses",
          .not_null = {true, true, true, false},
          .t_ns = {},
          .insert_sql =
              "INSERT OR REPLACE INTO losses (session_id, stream, robot_id, from_t_ns, to_t_ns, received, lost, "
              "gaps, overflow, nan_refused, rejected, out_of_order) "
              "VALUES (?, ?, ?, ?, ?, 0, 0, 0, 0, 0, 0, 0)",
          .counted = false};
}

RowTable withdrawn_silence_rows() {
  return {.name = "losses",
          .not_null = {true, true, true},
          .t_ns = {},
          .insert_sql = "DELETE FROM losses WHERE session_id = ? AND stream = ? AND robot_id = ? AND from_t_ns = ?",
          .counted = false};
}

RowTable simulation_rows() {
  return {.name = "sessions",
          .not_null = {false, false, false, false},
          .t_ns = {},
          .insert_sql =
              "UPDATE sessions SET simulated = 1, seed = coalesce(?2, seed), scenario = coalesce(?3, scenario), "
              "paired_halves = coalesce(?4, paired_halves), planned_s = coalesce(?5, planned_s) WHERE session_id = ?1",
          .counted = false,
          .amends = true};
}

SessionWriter::Fate SessionWriter::insert(const Row& row, const RowTable& table, SQLite::Statement& statement) {
  if (row.values.size() != table.not_null.size()) return Fate::kRejected;
  statement.tryReset();
  statement.clearBindings();
  statement.bind(1, session_id_);
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    const Value& value = row.values[i];
    const int parameter = static_cast<int>(i) + 2;
    const double* const number = std::get_if<double>(&value);
    if (number != nullptr && std::isinf(*number)) return Fate::kNan;
    if (std::holds_alternative<std::monostate>(value) || (number != nullptr && std::isnan(*number))) {
      if (table.not_null[i]) return Fate::kNan;
    } else if (number != nullptr) {
      statement.bind(parameter, *number);
    } else if (const auto* const integer = std::get_if<std::int64_t>(&value)) {
      statement.bind(parameter, *integer);
    } else if (const auto* const bytes = std::get_if<Blob>(&value)) {
      statement.bindNoCopy(parameter, bytes->data(), static_cast<int>(bytes->size()));
    } else {
      statement.bindNoCopy(parameter, std::get<std::string>(value));
    }
  }
  const int code = statement.tryExecuteStep();
  if (code == SQLITE_DONE) return Fate::kWritten;
  const int primary = code & 0xFF;
  if (primary == SQLITE_CONSTRAINT || primary == SQLITE_MISMATCH || primary == SQLITE_TOOBIG) return Fate::kRejected;
  throw SQLite::Exception(database_->getHandle(), code);
}

GroupResult SessionWriter::commit(const std::vector<Row>& group, const std::deque<RowTable>& tables,
                                  const LossCounters& loss_counters) {
  GroupResult result;
  std::map<std::size_t, Loss> counters;
  std::int64_t latest_t_ns = latest_t_ns_;
  SQLite::Transaction transaction(*database_);
  if (statements_.size() < tables.size()) statements_.resize(tables.size());
  for (const Row& row : group) {
    const RowTable& table = tables[row.table];
    auto& statement = statements_[row.table];
    if (!statement) statement = std::make_unique<SQLite::Statement>(*database_, table.insert_sql);
    Loss& loss = counters.try_emplace(row.table, Loss{.stream = table.name}).first->second;
    if (table.counted) ++loss.received;
    const Fate fate = insert(row, table, *statement);
    if (fate == Fate::kNan && ++loss.nan_refused == 1) {
      result.reasons.push_back(fmt::format("{}: NaN, infinity or nothing where a number must be", table.name));
    }
    if (fate == Fate::kRejected && ++loss.rejected == 1) {
      const bool counted_wrong = row.values.size() != table.not_null.size();
      result.reasons.push_back(
          fmt::format("{}: {}", table.name, counted_wrong ? "wrong number of values" : database_->getErrorMsg()));
    }
    if (fate != Fate::kWritten) continue;
    ++result.written;
    if (table.amends) ++result.amended;
    if (!table.t_ns) continue;
    if (const auto* const t_ns = std::get_if<std::int64_t>(&row.values[*table.t_ns])) {
      latest_t_ns = std::max(latest_t_ns, *t_ns);
    }
  }
  for (auto& statement : statements_) {
    if (statement) statement->tryReset();
  }
  LossCounters sums;
  for (const Loss& loss : loss_counters.all()) sums.add(loss);
  for (const auto& [table, loss] : counters) {
    if (!tables[table].counted && loss.missing() == 0) continue;
    sums.add(loss);
    result.counters.push_back(loss);
  }
  write_losses(sums.all(), latest_t_ns);
  transaction.commit();
  latest_t_ns_ = latest_t_ns;
  return result;
}

void SessionWriter::write_losses(const std::vector<Loss>& losses, std::int64_t latest_t_ns) {
  SQLite::Statement insert(*database_,
                           "INSERT OR REPLACE INTO losses (session_id, stream, robot_id, from_t_ns, to_t_ns, received, "
                           "lost, gaps, overflow, nan_refused, rejected, out_of_order) "
                           "VALUES (?, ?, 0, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const Loss& loss : losses)
    run(insert, session_id_, loss.stream, started_t_ns_, latest_t_ns, loss.received, loss.lost, loss.gaps,
        loss.overflow, loss.nan_refused, loss.rejected, loss.out_of_order);
}

void SessionWriter::commit_end(const LossCounters& loss_counters, std::optional<std::int64_t> closed_t_ns) {
  SQLite::Transaction transaction(*database_);
  write_losses(loss_counters.all(), latest_t_ns_);
  if (closed_t_ns) {
    run(*database_, "UPDATE sessions SET closed_t_ns = ? WHERE session_id = ?", *closed_t_ns, session_id_);
    if (schema_.contains("digests")) RowDigests(*database_).write(session_id_);
    if (schema_.contains("tallied_sessions")) write_tallies(*database_, session_id_);
  }
  transaction.commit();
}

bool SessionWriter::moved() const {
  int moved = 0;
  sqlite3_file_control(database_->getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  return moved != 0;
}

std::filesystem::path SessionWriter::write_again() {
  statements_.clear();
  std::filesystem::path path = path_;
  for (int n = 2; std::filesystem::exists(path); ++n) path = beside(path_, fmt::format(".{}", n).c_str());
  run(*database_, "VACUUM INTO ?", path.string());
  return path;
}

bool SessionWriter::fold() {
  statements_.clear();
  return log::fold(*database_);
}

}  // namespace trivela::log
