#include <fmt/format.h>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator::page {
namespace {

// Of a policy alone.
std::string one_policy(const PolicyRow& row) {
  const auto share = stats::efficiency(row.counts());
  if (!share) return fmt::format("{}: no kick whose outcome is known.", name_of(row));
  return fmt::format("{}: {} of {} kicks on target, {} (95 % {}).", name_of(row), row.inside(), row.counts().n,
                     percent(*share), percent(row.efficiency_ci()));
}

}  // namespace

std::string verdict_section(const PageView& view) {
  std::vector<std::string> verdicts, notes;
  if (view.data.comparison) {
    const PolicyComparison& comparison = *view.data.comparison;
    for (const PairResult& pair : comparison.pairs) {
      verdicts.push_back(verdict_sentence(pair, comparison));
      notes.push_back("Design: " + design_sentence(pair, comparison) + ".");
      if (const std::string needed = needed_sentence(pair, comparison); !needed.empty()) notes.push_back(needed);
    }
  } else {
    for (const PolicyRow& row : view.report.policies) verdicts.push_back(one_policy(row));
    if (view.report.policies.empty()) verdicts.emplace_back("There are no kicks.");
    notes.push_back("Nothing is compared: " + view.data.no_comparison + ".");
  }
  notes.emplace_back(
      "On target means between the posts and below the bar, saves included: it is not goals scored. An interval of 95 "
      "% "
      "is where the true value lies in 95 of 100 such reports, if kicks are alike and nothing else changed.");
  std::string body = "<div class=\"verdict\">\n" + paragraphs(verdicts) + "</div>\n";
  body += "<div class=\"caveat\">\n" + paragraphs(notes) + "</div>\n";
  return section("verdict", "Verdict", body);
}

}  // namespace trivela::evaluator::page
