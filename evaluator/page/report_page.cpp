#include "evaluator/page/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "evaluator/page/html.hpp"
#include "evaluator/page/page.css.hpp"
#include "evaluator/page/page.js.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/timeline/decided_again.hpp"

namespace trivela::evaluator::page {
namespace {

struct PagePart {
  const char* id;
  const char* title;
  std::string (*make)(const PageView&);
  bool (*is_there)(const PageData&) = [](const PageData&) { return true; };
};
constexpr std::array<PagePart, 14> kParts{
    {{"verdict", "Verdict", verdict_section},
     {"table2", "Table 2", table2_section},
     {"forest", "How often on target", forest_section},
     {"mouth", "The goal mouth", goal_mouth_section},
     {"pitch", "Where from", pitch_section},
     {"rates", "How often a minute", rates_section},
     {"predictions", "Predicted and observed", prediction_section},
     {"drift", "Is a kicker drifting?", drift_section},
     {"learning", "What kicks show of the kickers", learning_section},
     {"again", "Decided again", decided_again_section, [](const PageData& data) { return !data.again.empty(); }},
     {"changes", "What changed since the log before", changes_section,
      [](const PageData& data) { return data.logs.size() > 1; }},
     {"held", "Why held", held_section},
     {"list", "Kicks", kick_list_section},
     {"quality", "Data quality", quality_section}}};

/// What goes wrong in a section costs that section alone.
std::string guarded(const PagePart& part, const PageView& view) try {
  return section(part.id, part.title, part.make(view));
} catch (const std::exception& error) {
  return section(part.id, part.title, paragraphs({fmt::format("This section could not be made: {}", error.what())}));
}

std::string title_of(const PageData& data) {
  if (data.logs.size() == 1) return "Match report: " + data.logs.front().name;
  return fmt::format("Match report: {} logs", data.logs.size());
}

/// Match, opponent, venue and notes.
std::string said(const Report& report) {
  std::vector<std::string> lines;
  for (const SessionNote& note : report.notes) lines.push_back(line_of(note));
  return list_of(lines);
}

std::string simulated_banner(const Report& report) {
  if (report.simulated_sessions() == 0) return "";
  std::string words = kSimulated;
  if (report.simulated_sessions() < std::ssize(report.sessions))
    words += fmt::format(" Only {} of {} sessions are simulated; they are pooled all the same.",
                         report.simulated_sessions(), report.sessions.size());
  return "<p class=\"banner\">" + html(words.substr(0, words.find('\n'))) + html(words.substr(words.find('\n') + 1)) +
         "</p>\n";
}

std::string contents(const PageData& data) {
  std::string text = "<nav aria-label=\"Sections\"><ul>\n";
  for (const PagePart& part : kParts)
    if (part.is_there(data)) text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", part.id, part.title);
  return text + "</ul></nav>\n";
}

/// The timeline, by their place in the list.
std::string timelines(const PageData& data) {
  if (data.kicks.size() > kMostReplays) return "[]";
  std::string text = "[";
  for (const PageKick& kick : data.kicks)
    text += (text.size() > 1 ? ",\n" : "\n") + script_json(json_of(kick.timeline));
  return text + "\n]";
}

// Of a policy alone.
std::string one_policy(const PolicyRow& row) {
  const auto share = stats::efficiency(row.counts());
  if (!share) return fmt::format("{}: no kick whose outcome is known.", name_of(row));
  return fmt::format("{}: {} of {} kicks on target, {} (95 % {}).", name_of(row), row.inside(), row.counts().n,
                     percent(*share), percent(row.efficiency_ci()));
}

}  // namespace

std::string to_html(const Report& report, const PageData& data) {
  const PageView view{report, data, report.simulated_sessions() > 0};
  const std::string style = std::string(kPageCss) + std::string(replay_style());
  const std::string script = std::string(replay_script()) + std::string(kPageJs);
  const std::string title = html(title_of(data));
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; style-src {}; "
      "img-src data:; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      csp_hash(script), csp_hash(style), title, style);
  page += "<header>\n<h1>" + title + "</h1>\n" + simulated_banner(report) + said(report) + contents(data) +
          "</header>\n<main>\n";
  for (const PagePart& part : kParts)
    if (part.is_there(data)) page += guarded(part, view);
  page += "</main>\n<script type=\"application/json\" id=\"timelines\">" + timelines(data) + "</script>\n";
  return page + "<script>" + script + "</script>\n</body>\n</html>\n";
}

std::string report_page(const Report& report, const std::vector<std::filesystem::path>& logs,
                        const PageProgress& progress) {
  return to_html(report, read_page_data(logs, progress));
}

std::string decided_again_section(const PageView& view) {
  std::string body;
  for (const DecidedAgain& again : view.data.again) {
    body += "<h3>" + html(fmt::format("{}, decided again in {}", again.log, again.again_log)) + "</h3>\n";
    body += paragraphs(sentences_of(again));
    if (!again.orders.empty())
      body += table("What was ordered in a possession, and what would have been", table_of(again));
  }
  return body;
}

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
      "% is where the true value lies in 95 of 100 such reports, if kicks are alike and nothing else changed.");
  return "<div class=\"verdict\">\n" + paragraphs(verdicts) + "</div>\n<div class=\"caveat\">\n" + paragraphs(notes) +
         "</div>\n";
}

std::string table2_section(const PageView& view) {
  std::string body;
  for (const ReportPart& part : kick_parts(view.report)) {
    if (!part.table.empty()) body += table(part.title + (view.simulated ? " (simulated)" : ""), part.table);
    body += list_of(part.notes);
  }
  return body;
}

std::size_t colour_of(const PageView& view, const std::string& policy) {
  const auto found = std::ranges::find(view.report.policies, policy, &PolicyRow::policy);
  return static_cast<std::size_t>(found - view.report.policies.begin());
}

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
  return body.empty() ? paragraphs({"The logs' configurations could not be compared."}) : body;
}

}  // namespace trivela::evaluator::page
