#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

// No list without an item: LaTeX refuses it.
void latex_list(std::string& text, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  text += "\\begin{itemize}\n";
  for (const std::string& line : lines)
    text += fmt::format("\\item {}\n", latex_text(line.substr(line.find_first_not_of(' '))));
  text += "\\end{itemize}\n";
}

}  // namespace

std::string to_text(const Report& report) {
  using kicking::printable;
  const ReportParts parts = parts_of(report);
  std::string text;
  for (const std::string& line : parts.heading) text += printable(line) + "\n";
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n{}\n", part.title);
    if (!part.table.empty()) text += text_table(part.table);
    for (const std::string& note : part.notes) text += fmt::format("  {}\n", printable(note));
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, printable(parts.last));
}

std::string to_markdown(const Report& report) {
  const ReportParts parts = parts_of(report);
  std::string text = "# Report\n\n";
  for (const std::string& line : parts.heading)
    text += fmt::format("{}- {}\n", line.starts_with("  ") ? "  " : "",
                        markdown_text(line.substr(line.find_first_not_of(' '))));
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n## {}\n\n", markdown_text(part.title));
    if (!part.table.empty()) text += markdown_table(part.table);
    if (!part.table.empty() && !part.notes.empty()) text += "\n";
    for (const std::string& note : part.notes) text += fmt::format("- {}\n", markdown_text(note));
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, markdown_text(parts.last));
}

std::string to_latex(const Report& report) {
  const ReportParts parts = parts_of(report);
  std::string text = "% For \\input; \\usepackage[T1]{fontenc} and \\usepackage{textcomp} have every character.\n";
  latex_list(text, parts.heading);
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n\\subsection*{{{}}}\n", latex_text(part.title));
    if (!part.table.empty()) text += latex_table(part.table);
    latex_list(text, part.notes);
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, latex_text(parts.last));
}

namespace {

using CsvCells = std::vector<std::string>;

/// Columns that a number of no policy leaves empty, then its name and value.
std::string csv_head() {
  return fmt::format(
      "row,arm,policy,robot_id,inside,outside,unknown,efficiency,wilson95_lo,wilson95_hi,efficiency_unknown_out,"
      "efficiency_unknown_in,played_min,kicks_per_min,{},not_said,{},{},observed_bounced,observed_bounced_of,truth_"
      "bounced,truth_bounced_of,observed_saved,observed_saved_of,truth_saved,truth_saved_of,goals,goal_not_known,"
      "expected_wrong_inside,expected_wrong_outside,repeated_in_paired_halves,simulated,data_lost,name,value",
      fmt::join(kMisses, ","), kNoGoals[0].label, kNoGoals[1].label);
}

std::string csv_cell(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }
std::string csv_cell(double value) { return fmt::format("{}", value); }
std::string csv_cell(std::int64_t value) { return fmt::format("{}", value); }

std::string csv_row_line(const PolicyRow& row, const std::string& robot_id, const Report& report) {
  const auto wilson = row.efficiency_ci(), bounds = row.efficiency_bounds();
  CsvCells cells = {robot_id.empty() ? "policy" : "robot",
                    csv_text(row.arm),
                    csv_text(row.policy),
                    robot_id,
                    csv_cell(row.inside()),
                    csv_cell(row.outside()),
                    csv_cell(row.unknown()),
                    csv_cell(stats::efficiency(row.counts())),
                    csv_cell(wilson.lo),
                    csv_cell(wilson.hi),
                    csv_cell(bounds.lo),
                    csv_cell(bounds.hi),
                    csv_cell(row.played_min),
                    csv_cell(row.kicks_per_min())};
  for (const std::string& miss : kMisses) cells.push_back(csv_cell(row.of(miss)));
  for (const char* label : {"outside", kNoGoals[0].label, kNoGoals[1].label}) cells.push_back(csv_cell(row.of(label)));
  for (const ReportsOfInside& said : {row.inside_kicks.bounced, row.inside_kicks.saved})
    for (const std::int64_t n : {said.observed_yes, said.observed, said.truth_yes, said.truth})
      cells.push_back(csv_cell(n));
  cells.push_back(csv_cell(row.goals()));
  cells.push_back(csv_cell(row.goal_not_known()));
  cells.push_back(csv_cell(row.doubt.inside));
  cells.push_back(csv_cell(row.doubt.outside));
  cells.push_back(csv_cell(row.repeated));
  cells.push_back(report.simulated_sessions() > 0 ? "1" : "0");
  cells.push_back(report.data_lost() ? "1" : "0");
  return fmt::format("{},,\n", fmt::join(cells, ","));
}

// A number that belongs to no policy: `row` says to which part of the report, `name` which one.
std::string csv_number_line(const std::string& row, const std::string& name, const std::string& value) {
  static const auto between = static_cast<std::size_t>(std::ranges::count(csv_head(), ',') - 1);
  return fmt::format("{}{}{},{}\n", row, std::string(between, ','), csv_text(name), value);
}

std::string csv_quality_lines(const Report& report) {
  std::string text;
  const auto add = [&](const char* row, const std::string& name, const auto& value) {
    text += csv_number_line(row, name, csv_cell(value));
  };
  // Its numbers, named by the first cell of their row and by their column.
  const auto add_table = [&](const char* part, const Table& table) {
    for (const auto& row : table.rows) {
      for (std::size_t i = 1; i < row.size(); ++i) {
        const Json &of = row.front(), &value = row[i];
        const std::string name =
            fmt::format("{}: {}", of.is_string() ? of.get<std::string>() : of.dump(), table.columns[i].key);
        if (value.is_number_float()) add(part, name, value.get<double>());
        if (value.is_number_integer()) add(part, name, value.get<std::int64_t>());
      }
    }
  };
  add_table("sightings", sightings_table(report.labels));
  add_table("stream", loss_table(report.losses));
  for (const RefusedOrders& refused : report.refused_orders)
    add("refused_orders", fmt::format("{}: {}", refused.policy, refused.refusal), refused.orders);
  for (const RefusedOrders& refused : report.refused_orders)
    add("orders_not_fired", fmt::format("{}: {}", refused.policy, refused.refusal), refused.not_fired);
  add_table("length", length_table(report.lengths));
  const auto size = [](const auto& list) { return static_cast<std::int64_t>(list.size()); };
  add("quality", "sessions", size(report.sessions));
  add("quality", "rows_missing", report.rows_missing());
  add("quality", "unclosed_sessions", report.unclosed_sessions());
  add("quality", "unclosed_kicks", size(report.unclosed_kicks));
  add("quality", "silences", size(report.silences));
  add("quality", "verified_rows", report.verified_rows);
  add("quality", "compared_with_truth", report.compared_with_truth);
  add("quality", "alike_with_truth", report.alike_with_truth);
  for (const GateResult& gate : report.gates) {
    for (const Measured& of : gate.measured) text += csv_number_line("gate", gate.gate, csv_cell(of.value));
    add("gate_met", gate.gate, std::int64_t{gate.met});
  }
  return text;
}

}  // namespace

std::string to_csv(const Report& report) {
  std::string text = csv_head() + "\n";
  for (const PolicyRow& row : report.policies) text += csv_row_line(row, "", report);
  for (const RobotRow& row : report.robots) text += csv_row_line(row, fmt::to_string(row.robot_id), report);
  return text + csv_quality_lines(report);
}

}  // namespace trivela::evaluator
