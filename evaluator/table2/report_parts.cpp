#include "evaluator/table2/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "kicking/geometry/angle.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator {
namespace {

std::string shown(std::int64_t n) { return std::to_string(n); }

std::string shown(std::optional<double> x) { return x ? fmt::format("{:.2f}", *x) : "-"; }

// The first cells of a row: who kicked.
std::vector<std::string> who_of(const Report& report, const PolicyRow& row) {
  std::vector<std::string> cells;
  if (!report.arms.empty()) cells.push_back(row.arm.empty() ? "-" : row.arm);
  cells.push_back(row.policy.empty() ? "-" : row.policy);
  return cells;
}

std::vector<std::string> head_of(const Report& report, const std::vector<std::string>& rest) {
  std::vector<std::string> cells =
      report.arms.empty() ? std::vector<std::string>{"policy"} : std::vector<std::string>{"arm", "policy"};
  cells.insert(cells.end(), rest.begin(), rest.end());
  return cells;
}

void append(std::vector<std::string>& cells, const std::vector<std::string>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

std::vector<std::string> count_cells(const PolicyRow& row) {
  const auto efficiency = stats::efficiency(row.counts());
  return {shown(row.inside()),
          shown(row.outside()),
          shown(row.unknown()),
          efficiency ? percent(*efficiency) : "-",
          efficiency ? percent(row.efficiency_ci()) : "-",
          shown(row.played_min),
          shown(row.kicks_per_min())};
}

const std::vector<std::string> kCountHead = {"inside",      "outside", "unknown",       "efficiency",
                                             "Wilson 95 %", "minutes", "kicks a minute"};

ReportPart table2_part(const Report& report) {
  ReportPart part{report.arms.empty() ? "Table 2: kicks by policy" : "Table 2: kicks by arm",
                  {head_of(report, kCountHead)},
                  {"inside: between the posts and below the bar, saves included; it is not goals scored"}};
  std::vector<NamedInside> inside;
  bool blocked_apart = false;
  for (const PolicyRow& row : report.policies) {
    inside.push_back({name_of(row), row.inside_kicks});
    blocked_apart = blocked_apart || row.blocked_apart;
    append(part.table.emplace_back(who_of(report, row)), count_cells(row));
  }
  append(part.notes, inside_lines(inside));
  if (report.arms.size() > 1)
    part.notes.emplace_back("arms of an experiment meet the same opportunities, so that their kicks are not added up");
  if (blocked_apart) part.notes.emplace_back("blocked kicks stand apart, below: neither outside nor in the efficiency");
  for (const PolicyRow& row : report.policies) {
    if (row.repeated == 0) continue;
    part.notes.push_back(fmt::format(
        "{} of the kicks of {} are in situations that it had in an earlier half, too{}", row.repeated, name_of(row),
        row.paired_ci ? ": its interval takes each situation once"
                      : "; for an interval that allows for it these are too few situations"));
  }
  return part;
}

ReportPart goals_part(const Report& report) {
  ReportPart part{"Goals: inside, and no keeper stopped them",
                  {head_of(report, {"inside", "goals", "saved", "not known", "goals a minute"})},
                  {}};
  for (const PolicyRow& row : report.policies) {
    append(part.table.emplace_back(who_of(report, row)),
           {shown(row.inside()), shown(row.goals()), shown(row.saved()), shown(row.goal_not_known()),
            shown(row.per_min(row.goals()))});
  }
  return part;
}

ReportPart by_robot_part(const Report& report) {
  ReportPart part{"By robot", {head_of(report, kCountHead)}, {}};
  part.table[0].insert(part.table[0].begin(), "robot");
  for (const RobotRow& row : report.robots) {
    part.table.push_back(who_of(report, row));
    part.table.back().insert(part.table.back().begin(), shown(row.robot_id));
    append(part.table.back(), count_cells(row));
  }
  part.notes.emplace_back("minutes: of play, in the possessions in which the robot had the ball");
  return part;
}

ReportPart misses_part(const Report& report) {
  std::vector<std::string> names;
  names.reserve(kMisses.size());
  for (const std::string& miss : kMisses) names.push_back(words(miss));
  std::vector<std::string> rarer;  // that there are
  for (const char* const label : {"outside", kNoGoals[0].label, kNoGoals[1].label}) {
    if (std::ranges::none_of(report.policies, [&](const PolicyRow& row) { return row.of(label) > 0; })) continue;
    rarer.emplace_back(label);
    names.push_back(rarer.back() == "outside" ? "not said" : words(label));
  }
  names.emplace_back("unknown");
  ReportPart part{"Why the misses missed", {head_of(report, names)}, {}};
  for (const PolicyRow& row : report.policies) {
    std::vector<std::string>& cells = part.table.emplace_back(who_of(report, row));
    for (const std::string& miss : kMisses) cells.push_back(shown(row.of(miss)));
    for (const std::string& label : rarer) cells.push_back(shown(row.of(label)));
    cells.push_back(shown(row.unknown()));
  }
  return part;
}

ReportPart label_quality_part(const LabelQuality& labels) {
  Table table = sightings_table(labels);
  std::erase_if(table.rows, [](const auto& row) { return row[1] == 0; });
  ReportPart part{"Outcomes by sightings of the flight", texts_of(table), {}};
  if (!labels.has_probabilities) part.notes.emplace_back("the labels came without their probabilities");
  return part;
}

std::string with_error(const LearnedPart& part, double unit, int digits) {
  return fmt::format("{:+.{}f} ({:.{}f})", part.value / unit, digits, part.se / unit, digits);
}

constexpr std::size_t kMostKickers = 12;

// What robots learned of their kickers.
ReportPart kickers_part(const Report& report) {
  ReportPart part{"What kicks show of the kickers",
                  {{"robot", "kicks seen", "exit speed, %", "exit angle, deg", "direction, deg", "delay, ms",
                    "transfer along", "sideways"}},
                  {"differences from the robot's file after the last kick, standard errors in brackets"}};
  for (std::size_t i = 0; i < std::min(kMostKickers, report.kickers.size()); ++i) {
    const LearnedKicker& kicker = report.kickers[i];
    const KickerStep& last = kicker.steps.back();
    const double degree = kicking::radians(1.0);
    part.table.push_back({kicker.log.empty() ? shown(kicker.robot_id) : kicker.who(), shown(kicker.kicks()),
                          with_error(last.speed_ln, 0.01, 1), with_error(last.elevation_rad, degree, 1),
                          with_error(last.direction_rad, degree, 1), with_error(last.delay_s, 0.001, 0),
                          with_error(last.along, 1.0, 2), with_error(last.sideways, 1.0, 2)});
    append(part.notes, kicker.sentences());
  }
  if (report.kickers.size() > kMostKickers)
    part.notes.push_back(
        fmt::format("and {} more: trivela query LOG --metric kicker_updates", report.kickers.size() - kMostKickers));
  return part;
}

bool has_kicks(const Report& report) {
  return std::ranges::any_of(report.policies, [](const PolicyRow& row) { return row.kicks() > 0; });
}

// Nobody counts the sightings of somebody who watched a video.
bool imported_alone(const Report& report) { return report.imports.size() == report.sessions.size(); }

void add_lost_rows(ReportPart& part, const Report& report) {
  if (report.rows_missing() == 0) return part.notes.emplace_back("lost: nothing"), void();
  std::vector<log::Loss> missing;
  std::ranges::copy_if(report.losses, std::back_inserter(missing), [](const auto& loss) { return loss.missing() > 0; });
  part.table = texts_of(loss_table(missing));
}

void add_bounds(std::vector<std::string>& notes, const PolicyRow& row) {
  if (row.unknown() == 0 && row.doubt.sum() <= 0.0) return;
  std::string text = fmt::format("efficiency of {}: {}", name_of(row), percent(row.efficiency_bounds()));
  if (row.unknown() > 0) text += ", whatever the unknown kicks were";
  if (row.doubt.sum() > 0.0) {
    text += fmt::format("; mislabelled at most: {} inside, {} outside", stats::most_wrong(row.doubt.inside),
                        stats::most_wrong(row.doubt.outside));
  }
  notes.push_back(text);
}

ReportPart quality_part(const Report& report) {
  ReportPart part{"Data quality"};
  add_lost_rows(part, report);
  std::vector<std::string>& notes = part.notes;
  for (const std::string& warning : report.warnings) notes.push_back("warning: " + warning);
  for (const auto& lines : {report.not_counted, cut_short_lines(report.lengths), silence_lines(report.silences),
                            order_lines(report.unrecorded_orders)})
    append(notes, lines);
  notes.push_back(report.doubt ? *report.doubt
                               : fmt::format("verified: {} rows are as they were recorded", report.verified_rows));
  for (const RefusedOrders& refused : report.refused_orders) notes.push_back(line_of(refused));
  if (report.unclosed_kicks.empty()) notes.emplace_back("unclosed kicks: none");
  for (const UnclosedKick& kick : report.unclosed_kicks) {
    notes.push_back(line_of(kick));
  }
  for (const PolicyRow& row : report.policies) add_bounds(notes, row);
  if (report.hand_labels.kicks > 0) notes.push_back(report.hand_labels.line());
  if (report.compared_with_truth > 0) {
    notes.push_back(fmt::format("observed outcomes like the simulator's truth: {} of {}", report.alike_with_truth,
                                report.compared_with_truth));
  }
  return part;
}

}  // namespace

Table loss_table(std::span<const log::Loss> losses) {
  Table table{{{"stream", "lost"},
               {"received", "received"},
               {"missing", "", ""},
               {"lost", "lost on the bus"},
               {"gaps", "gaps"},
               {"overflow", "queue full"},
               {"nan_refused", "not a number"},
               {"rejected", "rejected"},
               {"out_of_order", "late"}}};
  for (const log::Loss& loss : losses)
    table.rows.push_back({loss.stream, loss.received, loss.missing(), loss.lost, loss.gaps, loss.overflow,
                          loss.nan_refused, loss.rejected, loss.out_of_order});
  return table;
}

Table sightings_table(const LabelQuality& labels) {
  Table table{{{"sightings", "sightings"},
               {"kicks", "kicks"},
               {"unknown", "unknown"},
               {"expected_wrong", "labels expected wrong", "{:.2f}"}}};
  for (const SightingsRow& row : labels.rows)
    table.rows.push_back(
        {row.sightings, row.kicks, row.unknown, labels.has_probabilities ? Json(row.expected_wrong) : Json()});
  return table;
}

Table length_table(std::span<const PlayedLength> lengths) {
  Table table{{{"session_id"}, {"planned_s"}, {"recorded_s"}, {"cut_short"}}};
  for (const PlayedLength& of : lengths)
    table.rows.push_back({of.session_id, of.planned_s, of.recorded_s, of.cut_short()});
  return table;
}

std::string line_of(const UnclosedKick& kick) {
  return fmt::format("unclosed kick {} of robot {} at {:.2f} s ({}): no{}{}{}", kick.kick_id, kick.robot_id,
                     kicking::seconds(kick.t_ns), kick.policy, kick.has_order ? "" : " order",
                     kick.has_receipt ? "" : " receipt", kick.has_outcome ? "" : " outcome");
}

std::string line_of(const RefusedOrders& refused) {
  if (refused.refusal == "not_known")
    return fmt::format(
        "kicks that may not have been fired: {} ({}): the driver was killed while it wrote to the device",
        refused.orders, refused.policy);
  std::string line =
      fmt::format("refused orders, no kicks: {} x {} ({})", refused.orders, words(refused.refusal), refused.policy);
  if (refused.not_fired > 0) line += fmt::format("; accepted at first and not fired: {}", refused.not_fired);
  return line;
}

std::string name_of(const PolicyRow& row) {
  if (row.arm.empty()) return row.policy + (row.beside_arms ? " (no arm)" : "");
  return row.arm.starts_with(row.policy) ? row.arm : fmt::format("{}/{}", row.arm, row.policy);
}

std::vector<ReportPart> kick_parts(const Report& report) {
  std::vector<ReportPart> parts{table2_part(report)};
  if (!has_kicks(report)) {
    parts.back().notes.emplace_back("there are no kicks");
    return parts;
  }
  if (report.keeper()) parts.push_back(goals_part(report));
  if (!report.robots.empty()) parts.push_back(by_robot_part(report));
  parts.push_back(misses_part(report));
  return parts;
}

ReportParts parts_of(const Report& report) {
  ReportParts result{heading_of(report), kick_parts(report), next_comparison(report)};
  if (has_kicks(report)) {
    if (!imported_alone(report)) result.parts.push_back(label_quality_part(report.labels));
    if (!report.kickers.empty()) result.parts.push_back(kickers_part(report));
  }
  result.parts.push_back(quality_part(report));
  if (!report.gates.empty()) {
    ReportPart& gates = result.parts.emplace_back(ReportPart{"Gates"});
    for (const GateResult& gate : report.gates) gates.notes.push_back(gate.sentence());
  }
  return result;
}

}  // namespace trivela::evaluator
