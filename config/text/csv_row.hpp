#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "config/text/csv_reader.hpp"

namespace trivela::config {

/// What is wrong with a cell, and in which column.
struct CellError : std::runtime_error {
  CellError(std::string_view column_name, const std::string& text, const std::string& reason);
};

/// What a column is measured in.
struct Unit {
  const char* symbol;
  const char* rule;  ///< the end of an error's sentence
};
inline constexpr Unit kMetres{"m", "lengths are in metres"};
inline constexpr Unit kSeconds{"s", "times are in seconds"};
inline constexpr Unit kMetresPerSecond{"m/s", "speeds are in metres a second"};
inline constexpr Unit kRadiansPerSecond{"rad/s", "rates of turn are in radians a second"};
inline constexpr Unit kDegreesPerSecond{"degrees/s", "rates of turn are in degrees a second"};

/// The cells of one record by column name. A column that is absent or empty has no value.
class Row {
 public:
  Row(const std::vector<std::string>& header, const std::vector<std::string>& cells) : header_(header), cells_(cells) {}

  bool has(std::string_view column) const;
  /// The cell's text; none if it is absent or empty.
  std::optional<std::string> word(std::string_view column) const;
  /// The cell's finite number. Throws CellError
  std::optional<double> number_if_any(std::string_view column) const;
  /// The same; a missing number is an error, too. Throws CellError
  double number(std::string_view column) const;
  /// The number if it lies in [low, high], an error saying so otherwise. Throws CellError
  double number_in(std::string_view column, double low, double high) const;
  /// The number if it is above zero. Throws CellError
  double positive(std::string_view column) const;
  /// A measured number of either sign: at most `most` of `unit` from 0, for what lies beyond was written in another
  /// unit. Throws CellError
  double measured(std::string_view column, double most, const Unit& unit) const;
  /// The same above 0. Throws CellError
  double measured_above_zero(std::string_view column, double most, const Unit& unit) const;
  /// Above 0 and at most `most_m`: what lies beyond was written in centimetres. Throws CellError
  double length_m(std::string_view column, double most_m) const;
  /// Angle in degrees between 0 and 90, both excluded, in radians. Throws CellError
  double acute_angle_rad(std::string_view column) const;

 private:
  const std::vector<std::string>& header_;
  const std::vector<std::string>& cells_;
};

/// A cell without blanks around it.
std::string trimmed(const std::string& cell);

/// Each cell without blanks around it.
std::vector<std::string> trimmed(const std::vector<std::string>& cells);

/// A record must have as many cells as the header. Throws CellError
void check_width(const std::vector<std::string>& header, const CsvRecord& record);

/// Calls `read` for each row of a table. Throws Error naming the file, and the line where `read` throws.
void each_row(const std::filesystem::path& table, const std::function<void(const Row&)>& read);

}  // namespace trivela::config
