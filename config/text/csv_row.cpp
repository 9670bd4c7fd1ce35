#include "config/text/csv_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "config/text/parse_number.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::config {

CellError::CellError(std::string_view column_name, const std::string& text, const std::string& reason)
    : std::runtime_error(text.empty() ? fmt::format("column {}: {}", column_name, reason)
                                      : fmt::format("column {}: '{}' {}", column_name, text, reason)) {}

std::string trimmed(const std::string& cell) {
  const auto first = cell.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> trimmed(const std::vector<std::string>& cells) {
  std::vector<std::string> result;
  std::ranges::transform(cells, std::back_inserter(result), [](const std::string& cell) { return trimmed(cell); });
  return result;
}

void check_width(const std::vector<std::string>& header, const CsvRecord& record) {
  if (record.cells.size() < header.size()) {
    throw CellError(header[record.cells.size()], "",
                    fmt::format("is missing: {} cells under {} columns", record.cells.size(), header.size()));
  }
  if (record.cells.size() > header.size()) {
    throw CellError(fmt::format("{}", header.size() + 1), record.cells[header.size()],
                    fmt::format("is too much: {} cells under {} columns", record.cells.size(), header.size()));
  }
}

bool Row::has(std::string_view column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::optional<std::string> Row::word(std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) return std::nullopt;
  std::string text = trimmed(cells_[static_cast<std::size_t>(found - header_.begin())]);
  return text.empty() ? std::nullopt : std::optional(std::move(text));
}

std::optional<double> Row::number_if_any(std::string_view column) const {
  const auto text = word(column);
  if (!text) return std::nullopt;
  const auto value = parse_decimal(*text);
  if (!value && std::ranges::count(*text, ',') == 1)
    throw CellError(column, *text, "has a decimal comma: save the table with decimal points");
  if (!value) throw CellError(column, *text, "is not a number");
  if (!std::isfinite(*value)) throw CellError(column, *text, "is not finite");
  return value;
}

double Row::number(std::string_view column) const {
  const auto value = number_if_any(column);
  if (!value) throw CellError(column, "", "is empty");
  return *value;
}

double Row::number_in(std::string_view column, double low, double high) const {
  const double value = number(column);
  if (value < low || value > high)
    throw CellError(column, *word(column), fmt::format("is not from {} to {}", low, high));
  return value;
}

double Row::positive(std::string_view column) const {
  const double value = number(column);
  if (value <= 0.0) throw CellError(column, *word(column), "is not above 0");
  return value;
}

double Row::measured(std::string_view column, double most, const Unit& unit) const {
  const double value = number(column);
  if (value > most)
    throw CellError(column, *word(column), fmt::format("is above {:g} {}: {}", most, unit.symbol, unit.rule));
  if (value < -most)
    throw CellError(column, *word(column), fmt::format("is below {:g} {}: {}", -most, unit.symbol, unit.rule));
  return value;
}

double Row::measured_above_zero(std::string_view column, double most, const Unit& unit) const {
  positive(column);
  return measured(column, most, unit);
}

double Row::length_m(std::string_view column, double most_m) const {
  return measured_above_zero(column, most_m, kMetres);
}

double Row::acute_angle_rad(std::string_view column) const {
  const double angle_deg = number(column);
  if (angle_deg <= 0.0 || angle_deg >= 90.0) throw CellError(column, *word(column), "is not between 0 and 90 degrees");
  return kicking::radians(angle_deg);
}

void each_row(const std::filesystem::path& table, const std::function<void(const Row&)>& read) {
  std::ifstream in = open_file(table);
  CsvReader reader{in, table.string()};
  const auto header = reader.next();
  while (const auto record = header ? reader.next() : std::nullopt) {
    try {
      check_width(header->cells, *record);
      read(Row{header->cells, record->cells});
    } catch (const std::exception& error) {
      throw Error{fmt::format("{}:{}: {}", table.string(), record->line, error.what())};
    }
  }
}

}  // namespace trivela::config
