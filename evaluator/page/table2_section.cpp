#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/no_goal.hpp"

namespace trivela::evaluator::page {
namespace {

using Cells = std::vector<std::string>;

const Cells kHead{"inside", "outside", "unknown", "efficiency", "95 %", "minutes", "kicks a minute"};
constexpr const char* kNone = "\u2013";

Cells joined(Cells first, const Cells& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

std::string misses_table(const Report& report) {
  std::set<std::string> kinds;  // that there are
  for (const PolicyRow& row : report.policies) {
    for (const auto& [label, n] : row.kicks_by_outcome) {
      if (n > 0 && label != "on_target") kinds.insert(label);
    }
  }
  if (kinds.empty()) return "";
  std::vector<Cells> rows{{"policy"}};
  for (const std::string& kind : kinds) rows[0].push_back(kind == "outside" ? "not said" : words(kind));
  for (const PolicyRow& row : report.policies) {
    Cells& cells = rows.emplace_back(Cells{name_of(row)});
    for (const std::string& kind : kinds) cells.push_back(std::to_string(row.of(kind)));
  }
  return table("Why the misses missed", rows);
}

std::string goals_table(const Report& report) {
  if (!report.keeper()) return "";
  std::vector<Cells> rows{joined({"policy"}, kGoalHead)};
  for (const PolicyRow& row : report.policies) rows.push_back(joined({name_of(row)}, goal_cells(row, kNone)));
  return table("Goals: inside, and no keeper stopped them", rows);
}

}  // namespace

std::string table2_section(const PageView& view) {
  const Report& report = view.report;
  std::vector<Cells> rows{joined({"policy"}, kHead)};
  std::vector<std::string> notes;
  for (const PolicyRow& row : report.policies) {
    rows.push_back(joined({name_of(row)}, count_cells(row, kNone)));
    if (row.repeated > 0) {
      notes.push_back(fmt::format("{} of the kicks of {} are in situations that it had in an earlier half, too.",
                                  row.repeated, name_of(row)));
    }
  }
  if (std::ranges::any_of(report.policies, &PolicyRow::blocked_apart))
    notes.emplace_back("Blocked kicks stand apart: neither outside nor in the efficiency.");
  if (rows.size() == 1) return section("table2", "Table 2", paragraphs({"There are no kicks."}));
  std::string body = table(std::string(view.simulated ? "Kicks by policy (simulated)" : "Kicks by policy"), rows);
  body += paragraphs(notes) + goals_table(report) + misses_table(report);
  if (!report.robots.empty()) {
    std::vector<Cells> by_robot{joined({"robot", "policy"}, kHead)};
    for (const RobotRow& row : report.robots)
      by_robot.push_back(joined({std::to_string(row.robot_id), name_of(row)}, count_cells(row, kNone)));
    body += table("By robot", by_robot);
  }
  return section("table2", "Table 2", body);
}

std::size_t colour_of(const PageView& view, const std::string& policy) {
  const auto found = std::ranges::find(view.report.policies, policy, &PolicyRow::policy);
  return static_cast<std::size_t>(found - view.report.policies.begin());
}

}  // namespace trivela::evaluator::page
