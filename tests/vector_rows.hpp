#pragma once

#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/text/csv_reader.hpp"

namespace trivela::tests {

/// A row of a file in tests/vectors, by column name.
class VectorRow {
 public:
  VectorRow(std::vector<std::string> header, config::CsvRecord record)
      : header_(std::move(header)), record_(std::move(record)) {}

  const std::string& text(std::string_view column) const {
    for (std::size_t i = 0; i < header_.size(); ++i) {
      if (header_[i] == column) return record_.cells.at(i);
    }
    throw std::out_of_range("no column " + std::string(column));
  }
  bool has(std::string_view column) const { return !text(column).empty(); }
  double number(std::string_view column) const { return std::stod(text(column)); }
  bool flag(std::string_view column) const { return number(column) != 0.0; }
  /// For SCOPED_TRACE: which row failed.
  std::string where() const { return "line " + std::to_string(record_.line); }

 private:
  std::vector<std::string> header_;
  config::CsvRecord record_;
};

/// All rows of tests/vectors/NAME. Throws if the file is missing or has no row, so that no loop over it tests nothing.
inline std::vector<VectorRow> rows(const std::string& name) {
  std::ifstream file(std::string(TRIVELA_SOURCE_DIR) + "/tests/vectors/" + name);
  config::CsvReader reader(file);
  const auto header = reader.next();
  std::vector<VectorRow> result;
  while (auto record = reader.next()) result.emplace_back(header->cells, std::move(*record));
  if (result.empty()) throw std::runtime_error("tests/vectors/" + name + ": no rows");
  return result;
}

}  // namespace trivela::tests
