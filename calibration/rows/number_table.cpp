#include "calibration/rows/number_table.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "config/text/error.hpp"
#include "config/text/open_file.hpp"

namespace trivela::calibration {
namespace {

using config::CsvRecord;

std::vector<CsvRecord> records_of(std::istream& in, const std::string& called) {
  std::vector<CsvRecord> records;
  config::CsvReader reader(in, called);
  while (auto record = reader.next()) records.push_back(std::move(*record));
  return records;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

bool is_number(const std::string& cell) {
  std::istringstream in(cell);
  double value = 0.0;
  return static_cast<bool>(in >> value) && (in >> std::ws).eof();
}

std::string trimmed(const std::string& text) {
  const auto words = words_of(text);
  return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> named_columns(const std::string& columns, const std::string& called) {
  std::vector<std::string> header;
  std::istringstream in(columns);
  for (std::string name; std::getline(in, name, ',');) header.push_back(trimmed(name));
  for (const std::string& name : header) {
    if (name.empty())
      throw config::BadArgument(fmt::format("{} {}: a name is empty; '-' skips a column", called, columns));
    if (name != "-" && std::ranges::count(header, name) > 1) {
      throw config::BadArgument(fmt::format("{} {}: {} stands twice", called, columns, name));
    }
  }
  return header;
}

}  // namespace

NumberTable NumberTable::read(const std::string& file, const std::string& columns, const std::string& called) {
  NumberTable table;
  table.file_ = file == "-" ? "standard input" : file;
  table.header_ = named_columns(columns, called);
  std::ifstream in;
  if (file != "-") in = config::open_file(file);
  table.records_ = records_of(file == "-" ? std::cin : in, table.file_);
  auto& records = table.records_;
  if (records.empty()) throw std::runtime_error(table.file_ + ": no rows");
  const bool numbers_first = std::ranges::any_of(records.front().cells, is_number);
  if (columns.empty()) {
    if (numbers_first) {
      throw std::runtime_error(fmt::format("{}:{}: the first line names no columns; name them with {}", table.file_,
                                           records.front().line, called));
    }
    for (const std::string& cell : records.front().cells) {
      table.header_.push_back(trimmed(cell));
      if (std::ranges::count(table.header_, table.header_.back()) > 1) {
        throw std::runtime_error(
            fmt::format("{}: column {} stands twice in the header", table.file_, table.header_.back()));
      }
    }
  }
  if (!numbers_first) records.erase(records.begin());  // a header that `columns` replaces is passed over
  if (records.empty()) throw std::runtime_error(table.file_ + ": a header and no rows");
  return table;
}

bool NumberTable::has(std::string_view column) const { return std::ranges::find(header_, column) != header_.end(); }

void NumberTable::require_one_of(const std::vector<std::string>& columns) const {
  if (std::ranges::any_of(columns, [this](const std::string& column) { return has(column); })) return;
  throw std::runtime_error(
      fmt::format("{}: no column {} (there are: {})", file_, fmt::join(columns, " or "), fmt::join(header_, ", ")));
}

void NumberTable::for_each(const std::function<void(const config::Row&)>& fn) const {
  for (const CsvRecord& record : records_) {
    if (record.cells.size() != header_.size()) {
      throw std::runtime_error(
          fmt::format("{}:{}: {} cells under {} columns", file_, record.line, record.cells.size(), header_.size()));
    }
    try {
      fn(config::Row(header_, record.cells));
    } catch (const config::CellError& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file_, record.line, error.what()));
    }
  }
}

}  // namespace trivela::calibration
