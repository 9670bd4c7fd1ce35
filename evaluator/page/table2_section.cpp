#include <algorithm>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"

namespace trivela::evaluator::page {

std::string table2_section(const PageView& view) {
  std::string body;
  for (const ReportPart& part : kick_parts(view.report)) {
    if (!part.table.empty()) body += table(part.title + (view.simulated ? " (simulated)" : ""), part.table);
    body += list_of(part.notes);
  }
  return section("table2", "Table 2", body);
}

std::size_t colour_of(const PageView& view, const std::string& policy) {
  const auto found = std::ranges::find(view.report.policies, policy, &PolicyRow::policy);
  return static_cast<std::size_t>(found - view.report.policies.begin());
}

}  // namespace trivela::evaluator::page
