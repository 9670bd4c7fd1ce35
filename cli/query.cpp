#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/counting/metrics.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/text/printable.hpp"
#include "log/read/reader.hpp"

namespace trivela::cli {
namespace {

using LogCell = log::Value;
using Json = nlohmann::ordered_json;

struct QueryArguments {
  std::string log;
  std::string sql;
  std::string metric;
  std::string file;
  bool list = false;
  bool csv = false;
  bool json = false;
};

/// NULL is an empty text; bytes are their hexadecimal digits.
std::string text_of_cell(const LogCell& cell) {
  if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return fmt::to_string(*whole);
  if (const auto* const number = std::get_if<double>(&cell)) return fmt::to_string(*number);
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  std::string digits;
  if (const auto* const bytes = std::get_if<log::Blob>(&cell)) {
    for (const auto byte : *bytes) digits += fmt::format("{:02x}", byte);
  }
  return digits;
}

Json json_of_cell(const LogCell& cell) {
  if (std::holds_alternative<std::monostate>(cell)) return nullptr;
  if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return *whole;
  if (const auto* const number = std::get_if<double>(&cell)) return *number;
  return text_of_cell(cell);
}

/// Numbers as they are, texts so that neither a terminal nor a spreadsheet obeys them.
std::string csv_line_of(std::span<const LogCell> row) {
  std::string line;
  for (const LogCell& cell : row) {
    if (&cell != row.data()) line += ',';
    line += std::holds_alternative<std::string>(cell) ? evaluator::csv_text(text_of_cell(cell)) : text_of_cell(cell);
  }
  return line + '\n';
}

std::vector<std::string> texts_of(std::span<const LogCell> row) {
  std::vector<std::string> texts;
  for (const LogCell& cell : row) texts.push_back(text_of_cell(cell));
  return texts;
}

std::string question(const QueryArguments& arguments) {
  const int asked = int{!arguments.sql.empty()} + int{!arguments.metric.empty()} + int{!arguments.file.empty()};
  if (asked != 1) throw UsageError{"give one of SQL, --metric NAME and --file FILE; --list explains the metrics"};
  if (!arguments.sql.empty()) return arguments.sql;
  if (arguments.metric.empty()) {
    return config::read_text_file(arguments.file);
  }
  const auto metric = evaluator::metric(arguments.metric);
  if (!metric) throw UsageError{fmt::format("there is no metric '{}': trivela query --list", arguments.metric)};
  return std::string(metric->sql);
}

void print_rows(log::Reader& reader, const QueryArguments& arguments) {
  const std::string asked = question(arguments);
  std::vector<std::vector<std::string>> rows;  // of a text alone: its columns are as wide as their widest cell
  std::vector<std::string> names;
  std::size_t count = 0;
  evaluator::ask_counted(
      reader, arguments.log, asked,
      [&](const std::vector<std::string>& columns) {
        names = columns;
        for (const std::string& name : names)
          if (arguments.json && std::ranges::count(names, name) > 1)
            throw UsageError{fmt::format("two columns are called '{}', which JSON cannot say: name them with AS",
                                         kicking::printable(name))};
        const std::vector<LogCell> head(names.begin(), names.end());
        if (arguments.csv) fmt::print("{}", csv_line_of(head));
        if (!arguments.csv && !arguments.json) rows.push_back(names);
      },
      [&](std::span<const LogCell> row) {
        ++count;
        if (arguments.csv) {
          fmt::print("{}", csv_line_of(row));
        } else if (arguments.json) {
          Json object = Json::object();
          for (std::size_t i = 0; i < names.size(); ++i) object[names[i]] = json_of_cell(row[i]);
          fmt::print("{}{}", count == 1 ? "[\n" : ",\n", object.dump(-1, ' ', true, Json::error_handler_t::replace));
        } else {
          rows.push_back(texts_of(row));
        }
      });
  if (arguments.json) fmt::print("{}\n", count == 0 ? "[]" : "\n]");
  if (!arguments.csv && !arguments.json) say(evaluator::text_table(rows));
}

void print_metrics() {
  for (const evaluator::Metric& metric : evaluator::metrics()) {
    std::string text = metric.explanation();
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 5) text.replace(at, 1, "\n    ");
    fmt::print("{}\n    {}\n", metric.name, text);
  }
}

int run_query(const QueryArguments& arguments) {
  if (arguments.list) {
    print_metrics();
    return kDone;
  }
  if (arguments.log.empty()) throw UsageError{"give a match log, or --list"};
  log::Reader reader(arguments.log);
  try {
    print_rows(reader, arguments);
  } catch (const log::BadQuestion& bad) {
    throw UsageError{fmt::format("cannot ask that: {}", bad.what())};
  }
  for (const std::string& warning : reader.warnings()) warn(warning);
  return kDone;
}

}  // namespace

void add_query(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "query", "Ask a match log: a metric by its name, or one SELECT of your own", run_query);
  verb->footer(R"(Tables and columns are those of log/schema/schema.sql; view
counted_kicks has each kick once. The log is only read.)");
  auto* const log = verb->add_option("log", arguments->log, "Match log, such as out/match.db");
  verb->add_option("sql", arguments->sql, "One SELECT, in quotes");
  verb->add_option("--metric", arguments->metric, "A question of --list by its name");
  verb->add_option("-f,--file", arguments->file, "File with one SELECT");
  auto* const csv = verb->add_flag("--csv", arguments->csv, "CSV instead of a table of text");
  verb->add_flag("--json", arguments->json, "JSON instead of a table of text")->excludes(csv);
  verb->add_flag("--list", arguments->list, "What the metrics are, with their columns")->excludes(log);
}

}  // namespace trivela::cli
