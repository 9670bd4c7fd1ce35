#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr std::size_t kMostKeys = 40;  // of a log

std::string changes_of(const LogChange& change, const PageData& data) {
  const std::string &before = data.logs[change.before].name, &after = data.logs[change.after].name;
  std::string body = "<h3>" + html(fmt::format("{}, after {}", after, before)) + "</h3>\n";
  if (change.differences.empty())
    return body + paragraphs({"Settings, robots, versions, scenario and seed are alike."});
  std::vector<std::vector<std::string>> rows{{"what", "before", "now"}};
  for (const LogDifference& of : std::span(change.differences).first(std::min(kMostKeys, change.differences.size())))
    rows.push_back({of.part + " " + of.key, shown_values(of.values[0]), shown_values(of.values[1])});
  body += table(fmt::format("What is not as in {}", before), rows);
  if (change.differences.size() > kMostKeys)
    body += paragraphs({fmt::format("And {} more keys: trivela compare {} {} --all has them.",
                                    change.differences.size() - kMostKeys, before, after)});
  return body;
}

}  // namespace

std::string changes_section(const PageView& view) {
  std::string body;
  for (const LogChange& change : view.data.changes) body += changes_of(change, view.data);
  if (body.empty()) body = paragraphs({"The logs' configurations could not be compared."});
  return section("changes", "What changed since the log before", body);
}

}  // namespace trivela::evaluator::page
