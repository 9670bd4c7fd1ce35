#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/verbs.hpp"
#include "config/text/csv_row.hpp"

namespace trivela::cli {

using config::CellError;
using config::Row;

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

/// A verb that works row by row: its input columns, the result columns for what the header has, the computation.
struct RowVerb {
  std::vector<Column> inputs;
  std::function<std::vector<std::string>(const std::function<bool(std::string_view)>& has)> results;
  std::function<std::vector<Value>(const Row&)> compute;
  std::function<std::string(const Row&)> draw = {};  ///< the row as SVG; none: the verb has no --svg
};

enum class RowFormat { kCsv, kJson };

/// Reads CSV from `in`, writes the rows with the results appended to `out`. A bad row is left out and named on `err`
/// with file, line, column and value. Returns kDone, or kFailed after a bad row. Throws std::runtime_error, with
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
/// The one row is drawn where --svg says so. Throws UsageError if flags and --csv are mixed, a required flag is
/// missing or its value is impossible.
ExitCode run_row_verb(const RowVerb& verb, const RowArguments& arguments);

/// The cells of both as a line of CSV (RFC 4180).
std::string csv_line(const std::vector<std::string>& given, const std::vector<std::string>& appended = {});

}  // namespace trivela::cli
