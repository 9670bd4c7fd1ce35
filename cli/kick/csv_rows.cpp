#include "cli/kick/csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "config/text/parse_number.hpp"
#include "evaluator/render/json_values.hpp"

namespace trivela::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string to_csv(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos && !cell.starts_with('#')) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string to_cell(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{:.10g}", *number + 0.0);  // no "-0"
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "1" : "0";
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return "";
}

Json to_json(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return nullptr;
}

Json given_to_json(const std::string& cell) {
  if (const auto number = config::parse_decimal(config::trimmed(cell)); number && std::isfinite(*number))
    return *number;
  return cell.empty() ? Json(nullptr) : Json(cell);
}

std::string flag_of(const Column& column) {
  std::string flag = "--" + column.name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

void check_header(const RowVerb& verb, const std::vector<std::string>& header, const std::string& file) {
  for (const Column& column : verb.inputs) {
    const auto count = std::count(header.begin(), header.end(), column.name);
    if (count > 1)
      throw std::runtime_error(fmt::format("{}: column {} stands {} times in the header", file, column.name, count));
    if (column.required && count == 0) {
      throw std::runtime_error(
          fmt::format("{}: no column {} in the header ({})", file, column.name, fmt::join(header, ", ")));
    }
  }
}

std::vector<Value> compute_record(const RowVerb& verb, const std::vector<std::string>& header,
                                  const config::CsvRecord& record) {
  check_width(header, record);
  return verb.compute(Row(header, record.cells));
}

}  // namespace

std::string csv_line(const std::vector<std::string>& given, const std::vector<std::string>& appended) {
  std::vector<std::string> cells;
  for (const auto* part : {&given, &appended})
    std::transform(part->begin(), part->end(), std::back_inserter(cells), to_csv);
  return fmt::format("{}\n", fmt::join(cells, ","));
}

ExitCode run_rows(const RowVerb& verb, std::istream& in, const std::string& file, RowFormat format, std::ostream& out,
                  std::ostream& err) {
  config::CsvReader reader(in, file);
  const auto head = reader.next();
  if (!head) throw std::runtime_error(file + ": no header line");
  const std::vector<std::string> header = config::trimmed(head->cells);
  check_header(verb, header, file);
  // To the end before anything is written: a text that is no CSV gives no rows.
  std::vector<config::CsvRecord> records;
  while (auto record = reader.next()) records.push_back(std::move(*record));
  const auto results =
      verb.results([&](std::string_view column) { return std::count(header.begin(), header.end(), column) > 0; });

  ExitCode code = kDone;
  Json objects = Json::array();
  if (format == RowFormat::kCsv) out << csv_line(head->cells, results);
  for (const config::CsvRecord& record : records) {
    try {
      const std::vector<Value> values = compute_record(verb, header, record);
      if (format == RowFormat::kCsv) {
        std::vector<std::string> cells;
        std::transform(values.begin(), values.end(), std::back_inserter(cells), to_cell);
        out << csv_line(record.cells, cells);
        continue;
      }
      Json& object = objects.emplace_back(Json::object());
      for (std::size_t i = 0; i < header.size(); ++i) object[header[i]] = given_to_json(record.cells[i]);
      for (std::size_t i = 0; i < results.size(); ++i) object[results[i]] = to_json(values[i]);
    } catch (const CellError& error) {
      err << fmt::format("{}:{}: {}\n", file, record.line, error.what());
      code = kFailed;
    }
  }
  if (format == RowFormat::kJson) out << evaluator::json_text(objects);
  out.flush();
  return code;
}

void add_row_flags(CLI::App& app, const RowVerb& verb, RowArguments& arguments) {
  app.add_option("--csv", arguments.csv, "Read rows from this file, - for standard input, and append the results")
      ->type_name("FILE|-");
  app.add_flag("--json", arguments.json, "Print JSON instead of CSV: an array with one object a row");
  if (verb.draw)
    app.add_option("--svg", arguments.svg, "Draw the one row's kick, from above and from the side")->type_name("FILE");
  for (const Column& column : verb.inputs) {
    const std::string flag = flag_of(column) + (column.alias.empty() ? "" : "," + column.alias);
    const std::string name = column.name;
    app.add_option_function<std::string>(
           flag, [&arguments, name](const std::string& text) { arguments.cells[name] = text; }, column.help)
        ->group("One row")
        ->type_name("");
  }
}

ExitCode run_row_verb(const RowVerb& verb, const RowArguments& arguments) {
  const RowFormat format = arguments.json ? RowFormat::kJson : RowFormat::kCsv;
  if (!arguments.csv.empty()) {
    if (!arguments.cells.empty()) throw UsageError("--csv goes without flags for single values");
    if (!arguments.svg.empty()) throw UsageError("--svg draws one kick and goes without --csv");
    if (arguments.csv == "-") return run_rows(verb, std::cin, "standard input", format, std::cout, std::cerr);
    std::ifstream file = open_file(arguments.csv);
    return run_rows(verb, file, arguments.csv, format, std::cout, std::cerr);
  }
  std::vector<std::string> header;
  std::vector<std::string> cells;
  for (const Column& column : verb.inputs) {
    const auto given = arguments.cells.find(column.name);
    if (given != arguments.cells.end()) {
      header.push_back(column.name);
      cells.push_back(given->second);
    } else if (column.required) {
      throw UsageError(fmt::format("{} is missing (or --csv FILE)", flag_of(column)));
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (kicking::first_unprintable(cells[i]))
      throw UsageError(fmt::format("column {}: not printable UTF-8", header[i]));
  }
  require_writable("--svg", arguments.svg);
  std::istringstream text(csv_line(header, {}) + csv_line(cells, {}));
  std::ostringstream out;
  std::ostringstream err;
  if (run_rows(verb, text, "command line", format, out, err) != kDone) {
    const std::string message = err.str();
    throw UsageError(message.substr(message.find("column"), message.find('\n') - message.find("column")));
  }
  if (!arguments.svg.empty()) write_file(arguments.svg, verb.draw(Row(header, cells)));
  std::cout << out.str() << std::flush;
  return kDone;
}

}  // namespace trivela::cli
