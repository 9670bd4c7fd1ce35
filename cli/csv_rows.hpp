#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cli/csv_reader.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {

/// A result: none (an empty cell), a number, a truth (1 or 0) or a word.
using Value = std::variant<std::monostate, double, bool, std::string>;

inline Value value_or_none(const std::optional<double>& number) {
  return number ? Value(*number) : Value(std::monostate{});
}

/// An input column; as a flag it is --name with '-' for '_'. `alias`: a second spelling of the flag.
struct Column {
  std::string name;
  std::string help;
  bool required = true;
  std::string alias = {};
};

/// What is wrong with a cell, and in which column.
struct CellError : std::runtime_error {
  CellError(std::string_view column_name, const std::string& text, const std::string& reason);
};

/// The cells of one record by column name. A column that is absent or empty has no value.
class Row {
 public:
  Row(const std::vector<std::string>& header, const std::vector<std::string>& cells) : header_(header), cells_(cells) {}

  bool has(std::string_view column) const;
  /// The cell's text; none if it is absent or empty.
  std::optional<std::string> word(std::string_view column) const;
  /// The cell's finite number. @throws CellError
  std::optional<double> number_if_any(std::string_view column) const;
  /// The same; a missing number is an error, too. @throws CellError
  double number(std::string_view column) const;
  /// The number if it lies in [low, high], an error saying so otherwise. @throws CellError
  double number_in(std::string_view column, double low, double high) const;
  /// The number if it is above zero. @throws CellError
  double positive(std::string_view column) const;
  /// Above 0 and at most `most_m`: what lies beyond was written in centimetres.
  double length_m(std::string_view column, double most_m) const;
  /// Angle in degrees between 0 and 90, both excluded, in radians. @throws CellError
  double acute_angle_rad(std::string_view column) const;

 private:
  const std::vector<std::string>& header_;
  const std::vector<std::string>& cells_;
};

/// Each cell without blanks around it.
std::vector<std::string> trimmed(const std::vector<std::string>& cells);

/// A record must have as many cells as the header. @throws CellError
void check_width(const std::vector<std::string>& header, const CsvRecord& record);

/// A verb that works row by row: its input columns, the result columns for what the header has, the computation.
struct RowVerb {
  std::vector<Column> inputs;
  std::function<std::vector<std::string>(const std::function<bool(std::string_view)>& has)> results;
  std::function<std::vector<Value>(const Row&)> compute;
  std::function<std::string(const Row&)> draw = {};  ///< the row as SVG; none: the verb has no --svg
};

enum class RowFormat { kCsv, kJson };

/// Reads CSV from `in`, writes the rows with the results appended to `out`. A bad row is left out and named on `err`
/// with file, line, column and value. @returns kDone, or kFailed after a bad row. @throws std::runtime_error, with
/// nothing written, if the header is unusable or CsvReader cannot read on.
ExitCode run_rows(const RowVerb& verb, std::istream& in, const std::string& file, RowFormat format, std::ostream& out,
                  std::ostream& err);

/// Where a row verb's input comes from, filled by its flags.
struct RowArguments {
  std::string csv;
  bool json = false;
  std::string svg = {};
  std::map<std::string, std::string> cells;  ///< by column name
};

/// Adds --csv, --json, --svg where the verb draws, and a flag for each input column. `arguments` must outlive the
/// parsing.
void add_row_flags(CLI::App& app, const RowVerb& verb, RowArguments& arguments);

/// Runs the verb over the file, standard input ("-") or the one row of the flags; writes to standard output and error.
/// The one row is drawn where --svg says so. @throws UsageError if flags and --csv are mixed, a required flag is
/// missing or its value is impossible.
ExitCode run_row_verb(const RowVerb& verb, const RowArguments& arguments);

}  // namespace trivela::cli
