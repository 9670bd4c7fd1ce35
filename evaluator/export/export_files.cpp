#include "evaluator/export/export_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {
namespace fs = std::filesystem;

/// "out/csv/" names the folder "out/csv".
fs::path without_slash(const fs::path& path) {
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

}  // namespace

Snapshot::~Snapshot() {
  try {
    reader_.query("COMMIT", [](auto) {});
  } catch (const std::exception&) {  // nothing was written
  }
}

std::vector<log::StreamTable> tables_of(const ExportPlan& plan) {
  std::vector<std::string> known;
  std::vector<log::StreamTable> tables;
  for (const log::StreamTable& table : log::stream_tables()) {
    known.push_back(table.name);
    if (plan.streams.empty() || std::ranges::find(plan.streams, table.name) != plan.streams.end())
      tables.push_back(table);
  }
  for (const std::string& name : plan.streams) {
    if (std::ranges::find(known, name) == known.end())
      throw BadExport(fmt::format("there is no stream \"{}\"; there are {}", name, fmt::join(known, ", ")));
  }
  return tables;
}

std::vector<log::RecordedSession> sessions_of(const ExportPlan& plan, const log::Reader& reader) {
  auto all = reader.sessions();
  if (plan.sessions.empty()) return all;
  std::vector<log::RecordedSession> chosen;
  for (const std::string& begin : plan.sessions) {
    const auto before = chosen.size();
    for (const log::RecordedSession& session : all) {
      const bool is_new = std::ranges::find(chosen, session.uuid, &log::RecordedSession::uuid) == chosen.end();
      if (session.uuid.starts_with(begin) && is_new) chosen.push_back(session);
    }
    if (chosen.size() == before)
      throw BadExport(
          fmt::format("no session begins with \"{}\"; trivela query DB 'SELECT uuid FROM sessions'", begin));
  }
  return chosen;
}

std::string only_sessions(const ExportPlan& plan, const log::Reader& reader) {
  if (plan.sessions.empty()) return "";
  std::vector<std::int64_t> ids;
  for (const log::RecordedSession& session : sessions_of(plan, reader)) ids.push_back(session.session_id);
  return fmt::format(" WHERE session_id IN ({})", fmt::join(ids, ", "));
}

std::int64_t count_rows(const ExportPlan& plan, const log::Reader& reader) {
  const std::string where = only_sessions(plan, reader);
  std::int64_t rows = 0;
  for (const log::StreamTable& table : tables_of(plan)) {
    reader.query(fmt::format("SELECT count(*) FROM {}{}", table.name, where), [&](std::int64_t n) { rows += n; });
  }
  return rows;
}

Draft::Draft(const fs::path& place) : place_(without_slash(place)), draft_(place_) {
  draft_ += fmt::format(".{}.new", getpid());
}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove_all(draft_, ignored);
}

void Draft::keep() {
  std::error_code failed;
  if (fs::is_directory(draft_) && fs::is_directory(place_)) {
    for (const auto& entry : fs::directory_iterator(draft_)) {
      if (!failed) fs::rename(entry.path(), place_ / entry.path().filename(), failed);
    }
  } else {
    fs::rename(draft_, place_, failed);
  }
  if (failed) throw std::runtime_error(fmt::format("cannot write {}: {}", place_.string(), failed.message()));
}

namespace {
constexpr std::size_t kPour_B = 1 << 18;

template <class Number>
void append_number(std::string& line, Number number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  line.append(digits.data(), end);
}

/// A file that is begun with its first row.
class CsvFile {
 public:
  CsvFile(fs::path path, const std::vector<std::string>& columns) : path_(std::move(path)) {
    text_ = fmt::format("{}\n", fmt::join(columns, ","));
  }

  void add(std::span<const log::Value> row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text_ += ',';
      append_csv_cell(text_, row[i]);
    }
    text_ += '\n';
    ++rows_;
    if (text_.size() >= kPour_B) pour();
  }

  std::int64_t finish() {
    if (rows_ > 0) pour();
    return rows_;
  }

 private:
  void pour() {
    errno = 0;
    if (!out_.is_open()) out_.open(path_, std::ios::binary);
    if (!(out_ << text_) || !out_.flush())
      throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
    text_.clear();
  }

  fs::path path_;
  std::string text_;
  std::ofstream out_;
  std::int64_t rows_ = 0;
};

}  // namespace

void append_csv_cell(std::string& line, const log::Value& cell) {
  if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return append_number(line, *whole);
  if (const auto* const number = std::get_if<double>(&cell)) return append_number(line, *number);
  if (const auto* const text = std::get_if<std::string>(&cell)) line += text->empty() ? "\"\"" : csv_text(*text);
}

ExportedRows export_csv(const log::Reader& reader, const ExportPlan& plan, const fs::path& folder,
                        const ExportProgress& progress) {
  const auto tables = tables_of(plan);
  const std::string where = only_sessions(plan, reader);
  Draft draft(folder);
  std::error_code failed;
  fs::create_directory(draft.path(), failed);
  if (failed) throw std::runtime_error(fmt::format("cannot write {}: {}", draft.path().string(), failed.message()));
  ExportPace pace(progress);
  ExportedRows rows;
  const Snapshot snapshot(reader);
  for (const log::StreamTable& table : tables) {
    std::vector<std::string> columns;
    for (const log::StreamColumn& column : table.columns) columns.push_back(column.name);
    CsvFile file(draft.path() / (table.name + ".csv"), columns);
    reader.query(fmt::format("SELECT {} FROM {}{} ORDER BY {}", fmt::join(columns, ", "), table.name, where, table.key),
                 [&](std::span<const log::Value> row) {
                   file.add(row);
                   pace.row();
                 });
    if (const std::int64_t n = file.finish(); n > 0) rows[table.name] = n;
  }
  draft.keep();
  return rows;
}

}  // namespace trivela::evaluator
