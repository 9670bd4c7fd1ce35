#include <fmt/format.h>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/story/decided_again.hpp"

namespace trivela::evaluator::page {

std::string decided_again_section(const PageView& view) {
  std::string body;
  for (const DecidedAgain& again : view.data.again) {
    body += "<h3>" + html(fmt::format("{}, decided again in {}", again.log, again.again_log)) + "</h3>\n";
    body += paragraphs(sentences_of(again));
    if (!again.orders.empty())
      body += table("What was ordered in a possession, and what would have been", table_of(again));
  }
  return section("again", "Decided again", body);
}

}  // namespace trivela::evaluator::page
