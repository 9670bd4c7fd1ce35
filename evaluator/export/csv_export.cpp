#include "evaluator/export/export_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;

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
