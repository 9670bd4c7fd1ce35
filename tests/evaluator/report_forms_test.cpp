#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "evaluator/render/gate.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using JsonValue = nlohmann::json;
using Table = std::vector<std::vector<std::string>>;

const std::string kHostile = "=1+1|`x`_*$\\&#%{}^~<b>[a](http://b.c)\"',@e\nwww.f";

/// A report with a number in every place, no two alike, and a name that means harm in every form.
Report full_report() {
  Report report;
  report.logs = {"a.db", kHostile};
  log::RecordedSession session;
  session.session_id = 5;
  session.uuid = "u";
  session.scenario = kHostile;
  session.software_version = kHostile;
  session.config_sha256 = "0123456789abcdef";
  session.simulated = true;
  session.seed = 77;
  report.sessions = {session};
  report.arms.push_back({.name = kHostile, .log = "a.db", .scenario = kHostile, .sessions = 3, .matches = 2});
  std::int64_t n = 3;
  const auto fill = [&](PolicyRow& row, const std::string& arm, const std::string& policy) {
    row.arm = arm;
    row.policy = policy;
    for (const char* const outcome : {"on_target", "unknown", "outside", "own_half", "carried_too_far"})
      row.kicks_by_outcome[outcome] = n += 2;
    for (const std::string& miss : kMisses) row.kicks_by_outcome[miss] = n += 3;
    row.doubt = {0.25 + static_cast<double>(n), 0.75};
    row.inside_kicks = {.bounced = {n + 1, n, n + 4, n + 2}, .saved = {n + 6, n + 3, n + 7, n + 5}};
    row.played_min = 1.37 * static_cast<double>(n);
    row.repeated = n + 5;
  };
  report.policies.resize(2);
  fill(report.policies[0], "", "stopped");
  fill(report.policies[1], kHostile, "moving");
  report.robots.resize(2);
  for (int i = 0; i < 2; ++i) {
    fill(report.robots[static_cast<std::size_t>(i)], i == 0 ? "" : kHostile, i == 0 ? "stopped" : "moving");
    report.robots[static_cast<std::size_t>(i)].robot_id = 4 + i;
  }
  report.lengths = {{.session_id = 5, .planned_s = 301.0, .recorded_s = 300.75}};
  report.losses = {{.stream = "odometry",
                    .received = 1001,
                    .lost = 12,
                    .gaps = 13,
                    .overflow = 14,
                    .nan_refused = 15,
                    .rejected = 16,
                    .out_of_order = 17}};
  report.refused_orders = {{"moving", "stale", 19, 4}};
  for (const char* const sightings : {"none", "1 to 4"})
    report.labels.rows.push_back({sightings, n += 2, n += 3, 0.5 * static_cast<double>(n)});
  report.labels.has_probabilities = true;
  report.warnings = {kHostile};
  report.verified_rows = 4321;
  report.compared_with_truth = 98;
  report.alike_with_truth = 97;
  return report;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What a reader of Markdown shows of a cell or line.
std::string read_markdown(const std::string& text) {
  std::string shown = std::regex_replace(text, std::regex(R"(\\([\\`*_{}\[\]|~$#().+-]))"), "$1");
  for (const auto& [entity, character] : {std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"}, std::pair{"&#64;", "@"},
                                          std::pair{"&#58;", ":"}, std::pair{"&amp;", "&"}})
    shown = std::regex_replace(shown, std::regex(entity), character);
  return shown;
}

std::string read_latex(std::string text) {
  for (const auto& [command, character] :
       {std::pair{R"(\\textbackslash\{\})", "\\\\"}, std::pair{R"(\\textasciitilde\{\})", "~"},
        std::pair{R"(\\textasciicircum\{\})", "^"}, std::pair{R"(\\textless\{\})", "<"},
        std::pair{R"(\\textgreater\{\})", ">"}, std::pair{R"(\\textbar\{\})", "|"},
        std::pair{R"(\\textquotedbl\{\})", "\""}, std::pair{R"(\\textquotesingle\{\})", "'"},
        std::pair{R"(\\textasciigrave\{\})", "`"}, std::pair{R"(\{\[\})", "["}, std::pair{R"(\{\]\})", "]"},
        std::pair{R"(-\{\}-)", "--"}})
    text = std::regex_replace(text, std::regex(command), character);
  text = std::regex_replace(text, std::regex(R"(\\([{}$&#_%]))"), "$1");
  return std::regex_replace(text, std::regex(R"(\\\\)"), "\\");
}

/// The cells between separators that no backslash stands before.
std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size()) {
      cells.back() += line[i++];
      cells.back() += line[i];
    } else if (line[i] == separator) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
  }
  return cells;
}

std::vector<Table> markdown_tables(const std::string& text) {
  std::vector<Table> tables;
  bool in_table = false;
  for (const std::string& line : lines_of(text)) {
    const bool row = line.starts_with("|");
    if (row && !in_table) tables.emplace_back();
    in_table = row;
    if (!row || line.starts_with("|:--")) continue;
    auto cells = cells_of(line.substr(1), '|');
    cells.pop_back();
    for (std::string& cell : cells) cell = read_markdown(cell);
    tables.back().push_back(cells);
  }
  return tables;
}

std::vector<Table> latex_tables(const std::string& text) {
  std::vector<Table> tables;
  bool in_table = false;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("\\begin{tabular}")) {
      tables.emplace_back();
      in_table = true;
    } else if (line.starts_with("\\end{tabular}")) {
      in_table = false;
    } else if (in_table && line != "\\hline") {
      auto cells = cells_of(line.substr(0, line.size() - 3), '&');
      for (std::string& cell : cells) cell = read_latex(cell);
      tables.back().push_back(cells);
    }
  }
  return tables;
}

std::vector<Table> tables_of(const Report& report) {
  std::vector<Table> tables;
  for (const ReportPart& part : parts_of(report).parts) {
    if (part.table.empty()) continue;
    tables.push_back(part.table);
    for (auto& row : tables.back())
      for (std::string& cell : row) cell = kicking::printable(cell);
  }
  return tables;
}

TEST(ReportForms, MarkdownAndLatexHaveTheTablesOfTheText) {
  const Report report = full_report();
  const auto tables = tables_of(report);
  ASSERT_EQ(tables.size(), 6u) << "Table 2, goals, robots, misses, sightings, losses";
  EXPECT_EQ(markdown_tables(to_markdown(report)), tables);
  EXPECT_EQ(latex_tables(to_latex(report)), tables);
  for (const Table& table : tables) {
    for (const auto& row : table) {
      for (const std::string& cell : row) EXPECT_THAT(to_text(report), HasSubstr(cell));
    }
  }
}

/// The numbers of a shown cell: "87.8 %" is 0.878, within half of its last digit.
void expect_shown(const std::string& cell, const JsonValue& value, const std::string& name) {
  if (value.is_null()) {
    EXPECT_EQ(cell, "-") << name;
    return;
  }
  const double number = value.get<double>();
  const bool percent = cell.ends_with('%');
  const double tolerance = percent ? 0.0501 : cell.find('.') == std::string::npos ? 0.0 : 0.00501;
  EXPECT_NEAR(std::stod(cell), percent ? 100.0 * number : number, tolerance) << name;
}

void expect_counts(const std::vector<std::string>& row, std::size_t first, const JsonValue& json) {
  const std::size_t to = row[first + 4].find(" to ");
  const std::vector<std::pair<std::string, JsonValue>> numbers = {{row[first], json["inside"]},
                                                                  {row[first + 1], json["outside"]},
                                                                  {row[first + 2], json["unknown"]},
                                                                  {row[first + 3], json["efficiency"]},
                                                                  {row[first + 5], json["played_min"]},
                                                                  {row[first + 6], json["kicks_per_min"]},
                                                                  {row[first + 4].substr(0, to), json["wilson95"][0]},
                                                                  {row[first + 4].substr(to + 4), json["wilson95"][1]}};
  for (const auto& [cell, value] : numbers) expect_shown(cell, value, value.dump());
}

TEST(ReportForms, TheTablesHaveTheNumbersOfTheJson) {
  const Report report = full_report();
  const auto json = JsonValue::parse(to_json(report));
  const auto tables = tables_of(report);
  for (std::size_t i = 0; i < 2; ++i) {
    expect_counts(tables[0][i + 1], 2, json["policies"][i]);
    expect_counts(tables[2][i + 1], 3, json["robots"][i]);
    EXPECT_EQ(tables[2][i + 1][0], json["robots"][i]["robot_id"].dump());
    const JsonValue& saved = json["policies"][i]["saved"]["observed"];
    expect_shown(tables[1][i + 1][4], saved["saved"], "saved");
    expect_shown(tables[1][i + 1][3], saved["of"].get<int>() - saved["saved"].get<int>(), "goals");
    const JsonValue& misses = json["policies"][i]["misses"];
    for (std::size_t m = 0; m < kMisses.size(); ++m)
      expect_shown(tables[3][i + 1][m + 2], misses[kMisses[m]], kMisses[m]);
    expect_shown(tables[3][i + 1][kMisses.size() + 2], misses["outside"], "not said");
    expect_shown(tables[3][i + 1][kMisses.size() + 3], misses["own_half"], "own half");
    expect_shown(tables[3][i + 1][kMisses.size() + 4], misses["carried_too_far"], "carried too far");
    const JsonValue& sightings = json["data_quality"]["labels"]["by_sightings"][i];
    expect_shown(tables[4][i + 1][1], sightings["kicks"], "kicks by sightings");
    expect_shown(tables[4][i + 1][2], sightings["unknown"], "unknown by sightings");
    expect_shown(tables[4][i + 1][3], sightings["expected_wrong"], "wrong by sightings");
  }
  const JsonValue& stream = json["data_quality"]["streams"][0];
  std::size_t column = 0;
  for (const char* const key : {"received", "lost", "gaps", "overflow", "nan_refused", "rejected", "out_of_order"})
    expect_shown(tables[5][1][++column], stream[key], key);
}

/// RFC 4180.
Table read_csv(const std::string& text) {
  Table rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

struct CsvReport {
  explicit CsvReport(const std::string& text) : rows(read_csv(text)) {}

  std::string of(std::size_t row, const std::string& column) const {
    const auto place = std::ranges::find(rows.front(), column) - rows.front().begin();
    return rows.at(row).at(static_cast<std::size_t>(place));
  }
  std::string value(const std::string& row, const std::string& name) const {
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (of(i, "row") == row && of(i, "name") == name) return of(i, "value");
    return "none";
  }

  Table rows;
};

void expect_number(const std::string& cell, const JsonValue& value, const std::string& name) {
  if (value.is_null()) {
    EXPECT_EQ(cell, "") << name;
  } else {
    EXPECT_EQ(std::stod(cell), value.get<double>()) << name;
  }
}

void expect_row(const CsvReport& csv, std::size_t row, const JsonValue& json) {
  for (const char* const key :
       {"inside", "outside", "unknown", "efficiency", "played_min", "kicks_per_min", "repeated_in_paired_halves"})
    expect_number(csv.of(row, key), json[key], key);
  for (const std::string& miss : kMisses) expect_number(csv.of(row, miss), json["misses"][miss], miss);
  const std::vector<std::pair<std::string, JsonValue>> others = {
      {"wilson95_lo", json["wilson95"][0]},
      {"wilson95_hi", json["wilson95"][1]},
      {"efficiency_unknown_out", json["efficiency_bounds"][0]},
      {"efficiency_unknown_in", json["efficiency_bounds"][1]},
      {"not_said", json["misses"]["outside"]},
      {"own_half", json["misses"]["own_half"]},
      {"carried_too_far", json["misses"]["carried_too_far"]},
      {"expected_wrong_inside", json["expected_wrong"]["inside"]},
      {"expected_wrong_outside", json["expected_wrong"]["outside"]},
      {"observed_bounced", json["bounced"]["observed"]["bounced"]},
      {"observed_bounced_of", json["bounced"]["observed"]["of"]},
      {"truth_bounced", json["bounced"]["truth"]["bounced"]},
      {"truth_bounced_of", json["bounced"]["truth"]["of"]},
      {"observed_saved", json["saved"]["observed"]["saved"]},
      {"observed_saved_of", json["saved"]["observed"]["of"]},
      {"truth_saved", json["saved"]["truth"]["saved"]},
      {"truth_saved_of", json["saved"]["truth"]["of"]}};
  for (const auto& [column, value] : others) expect_number(csv.of(row, column), value, column);
}

TEST(ReportForms, TheCsvHasTheNumbersOfTheJson) {
  const Report report = full_report();
  const auto json = JsonValue::parse(to_json(report));
  const CsvReport csv(to_csv(report));
  for (const auto& row : csv.rows) EXPECT_EQ(row.size(), csv.rows.front().size());
  expect_row(csv, 1, json["policies"][0]);
  expect_row(csv, 2, json["policies"][1]);
  expect_row(csv, 3, json["robots"][0]);
  expect_row(csv, 4, json["robots"][1]);
  EXPECT_EQ(csv.of(4, "robot_id"), "5");
  const JsonValue& quality = json["data_quality"];
  for (const JsonValue& row : quality["labels"]["by_sightings"]) {
    for (const char* const key : {"kicks", "unknown", "expected_wrong"})
      expect_number(csv.value("sightings", row["sightings"].get<std::string>() + ": " + key), row[key], key);
  }
  for (const char* const key :
       {"received", "missing", "lost", "gaps", "overflow", "nan_refused", "rejected", "out_of_order"})
    expect_number(csv.value("stream", std::string("odometry: ") + key), quality["streams"][0][key], key);
  expect_number(csv.value("refused_orders", "moving: stale"), quality["refused_orders"][0]["orders"], "refused");
  expect_number(csv.value("orders_not_fired", "moving: stale"), quality["refused_orders"][0]["not_fired"], "not fired");
  expect_number(csv.value("length", "5: planned_s"), quality["lengths"][0]["planned_s"], "planned");
  expect_number(csv.value("length", "5: recorded_s"), quality["lengths"][0]["recorded_s"], "recorded");
  expect_number(csv.value("quality", "rows_missing"), quality["rows_missing"], "missing");
  expect_number(csv.value("quality", "verified_rows"), quality["verification"]["verified_rows"], "verified");
  expect_number(csv.value("quality", "compared_with_truth"), quality["truth"]["compared"], "compared");
  expect_number(csv.value("quality", "alike_with_truth"), quality["truth"]["alike"], "alike");
}

TEST(ReportForms, TheSameReportIsTheSameBytes) {
  for (const auto render : {to_text, to_csv, to_markdown, to_latex})
    EXPECT_EQ(render(full_report()), render(full_report()));
}

TEST(ReportForms, AHostileNameStaysAName) {
  const Report report = full_report();
  EXPECT_EQ(CsvReport(to_csv(report)).of(2, "arm"), "'" + kicking::printable(kHostile))
      << "no formula, and one cell of one line";
  const std::string markdown = to_markdown(report);
  for (const char* const markup : {"<b>", "[a](", "http://", "\n=1", "@e", "\\|`"})
    EXPECT_THAT(markdown, Not(HasSubstr(markup)));
  EXPECT_THAT(markdown, HasSubstr("\\`x\\`\\_\\*\\$\\\\&amp;\\#%\\{\\}"));
  EXPECT_THAT(to_latex(report), HasSubstr("\\textbackslash{}\\&\\#\\%\\{\\}\\textasciicircum{}"));
}

TEST(EscapedText, OfEveryCharacterIsReadBack) {
  for (int c = 0x20; c < 0x7F; ++c) {
    for (const std::string& text : {std::string(1, static_cast<char>(c)), fmt::format("a{}b", static_cast<char>(c)),
                                    fmt::format("{0}{0} c", static_cast<char>(c))}) {
      EXPECT_EQ(read_markdown(markdown_text(text)), text);
      EXPECT_EQ(read_latex(latex_text(text)), text);
    }
  }
  EXPECT_EQ(markdown_text("1. a"), "1\\. a") << "no list";
  EXPECT_EQ(markdown_text("87.8 %"), "87.8 %");
  EXPECT_EQ(markdown_text("a\nb"), "a\\\\x0ab");
}

TEST(EscapedText, OfACsvIsNoFormula) {
  for (const char* const text : {"=1", "+1", "-1", "@a", "\ta"}) EXPECT_THAT(csv_text(text), StartsWith("'"));
  EXPECT_EQ(csv_text("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csv_text("a=1"), "a=1");
  EXPECT_EQ(csv_text("a\r\nb"), "a\\x0d\\x0ab");
}

}  // namespace
}  // namespace trivela::evaluator
