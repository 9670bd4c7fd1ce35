#include <fmt/format.h>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/merge_report.hpp"
#include "evaluator/table2/report_parts.hpp"

namespace trivela::evaluator::page {
namespace {

using Cells = std::vector<std::string>;

std::string n_of(std::int64_t n) { return std::to_string(n); }

std::string missing(const Report& report) {
  std::string body = "<h3>Missing</h3>\n";
  body += paragraphs({report.rows_missing() == 0 ? "No row is missing of those that were sent."
                                                 : fmt::format("{} rows are missing.", report.rows_missing())});
  body += list_of(silence_lines(report.silences)) + list_of(order_lines(report.unrecorded_orders)) +
          list_of(cut_short_lines(report.lengths));
  if (report.losses.empty()) return body;
  std::vector<Cells> rows = texts_of(loss_table(report.losses));
  rows.front().front() = "stream";
  return body + details("By stream", table("Rows by stream", rows));
}

std::string bounds(const Report& report) {
  std::vector<Cells> rows{{"policy", "unknown", "efficiency", "if all unknown were outside, or inside"}};
  for (const PolicyRow& row : report.policies) {
    const auto share = stats::efficiency(row.counts());
    rows.push_back({name_of(row), n_of(row.unknown()), share ? percent(*share) : "–",
                    row.kicks() > 0 ? percent(row.efficiency_bounds()) : "–"});
  }
  if (rows.size() == 1) return "";
  std::string body = "<h3>Unknown outcomes</h3>\n" + table("What unknown outcomes could make of the efficiency", rows);
  body += paragraphs(
      {"The bounds allow for labels that may be wrong, too, as far as the observer gave them a probability."});
  if (report.hand_labels.kicks > 0) body += paragraphs({report.hand_labels.line()});
  if (report.compared_with_truth > 0) {
    body += paragraphs({fmt::format(
        "Observed outcomes like the simulator's truth: {} of {}. Nothing else on this page knows the truth.",
        report.alike_with_truth, report.compared_with_truth)});
  }
  return body;
}

std::string orders(const Report& report) {
  std::vector<std::string> lines;
  for (const RefusedOrders& refused : report.refused_orders) lines.push_back(line_of(refused));
  constexpr std::size_t kMostLines = 20;
  for (const UnclosedKick& kick : report.unclosed_kicks) {
    if (lines.size() == kMostLines) break;
    lines.push_back(line_of(kick));
  }
  if (report.unclosed_kicks.size() > kMostLines)
    lines.push_back(fmt::format("{} unclosed kicks in all", report.unclosed_kicks.size()));
  return lines.empty() ? "" : "<h3>Orders</h3>\n" + list_of(lines);
}

std::string clocks(const PageData& data) {
  std::string body = "<h3>Clocks</h3>\n";
  if (data.clocks.empty() && data.aligned.empty())
    return body + paragraphs({"No clock was measured against another: instants are by each recorder's own clock."});
  if (!data.clocks.empty()) {
    std::vector<Cells> rows{{"who measured", "whose clock", "measurements", "ahead by", "best known to"}};
    for (const ClockRow& row : data.clocks) {
      rows.push_back({participant(row.robot_id), participant(row.other_robot_id), n_of(row.measurements),
                      fmt::format("{:+.3f} to {:+.3f} ms", row.least_ms, row.most_ms),
                      fmt::format("± {:.3f} ms", row.error_ms)});
    }
    body += table("Clock offsets", rows);
  }
  std::vector<std::string> lines;
  for (const AlignedClock& clock : data.aligned)
    lines.push_back(fmt::format("session {} is on the clock of session {}, known to ± {:.3f} ms", clock.uuid,
                                clock.reference_uuid, clock.error_ms));
  return body + list_of(lines);
}

std::string sessions(const Report& report) {
  constexpr std::size_t kMostSessions = 100;
  std::vector<Cells> rows{
      {"session", "scenario or match", "simulated", "robot", "seed", "version", "configuration", "messages"}};
  for (const log::RecordedSession& session : report.sessions) {
    if (rows.size() > kMostSessions) break;
    rows.push_back({session.uuid, session.scenario, session.simulated ? "yes" : "no",
                    session.robot_id ? n_of(*session.robot_id) : "all", session.seed ? n_of(*session.seed) : "–",
                    session.software_version, session.config_sha256.substr(0, 12), session.idl_sha256.substr(0, 12)});
  }
  std::string body = "<h3>Versions</h3>\n" + table("Sessions", rows);
  if (report.sessions.size() > kMostSessions)
    body += paragraphs({fmt::format("{} sessions in all.", report.sessions.size())});
  std::vector<std::string> notes;
  for (const auto& [session, lines] : report.imports) notes.insert(notes.end(), lines.begin(), lines.end());
  return body + list_of(notes);
}

std::string inputs(const PageData& data) {
  std::vector<Cells> rows{{"log", "file", "SHA-256"}};
  for (std::size_t i = 0; i < data.logs.size(); ++i)
    rows.push_back({n_of(static_cast<std::int64_t>(i) + 1), data.logs[i].name, data.logs[i].sha256});
  return "<h3>Inputs</h3>\n" + table("Files that this page was made of", rows);
}

}  // namespace

std::string quality_section(const PageView& view) {
  const Report& report = view.report;
  std::vector<std::string> warnings = view.data.failures;
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  warnings.insert(warnings.end(), report.not_counted.begin(), report.not_counted.end());
  if (report.doubt) warnings.push_back(*report.doubt);
  std::string body = list_of(warnings);
  if (!report.doubt && report.verified_rows > 0)
    body += paragraphs({fmt::format("Verified: {} rows are as they were recorded.", report.verified_rows)});
  return body + missing(report) + bounds(report) + orders(report) + clocks(view.data) + sessions(report) +
         inputs(view.data);
}

}  // namespace trivela::evaluator::page
