#pragma once

#include <span>
#include <string>
#include <vector>

#include "evaluator/render/table.hpp"
#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {

/// A part of a report for readers: a table, sentences under it. Numbers are rounded as people read them; names are as
/// they stand in the log, and whoever renders them makes them harmless.
struct ReportPart {
  std::string title;
  std::vector<std::vector<std::string>> table{};  ///< the first row is the head; empty: none
  std::vector<std::string> notes{};
};

/// A report as text, Markdown and LaTeX have it.
struct ReportParts {
  std::vector<std::string> heading;  ///< sentences: what was played
  std::vector<ReportPart> parts;
  std::string last;  ///< the comparison to go on with; empty: there is nothing to compare
};

ReportParts parts_of(const Report& report);

/// Those on kicks: Table 2, goals, robots, why the misses missed.
std::vector<ReportPart> kick_parts(const Report& report);

// Tables that every form has.
Table loss_table(std::span<const log::Loss> losses);
Table sightings_table(const LabelQuality& labels);
Table length_table(std::span<const PlayedLength> lengths);

/// "unclosed kick 7 of robot 1 at 3.20 s (moving): no receipt outcome".
std::string line_of(const UnclosedKick& kick);

/// "moving"; of an experiment the arm, and its policy where that is another word; "moving (no arm)" beside arms.
std::string name_of(const PolicyRow& row);

/// Sentences on what was played: the arms of experiments, other sessions one by one. What belongs to the one before
/// begins with two blanks.
std::vector<std::string> heading_of(const Report& report);

/// The `trivela compare` that says how sure the differences of a report are, as a line to copy: by arm, policy, log or
/// robot, whichever there are several of, in that order. Empty where there is nothing to compare: no kick, or replays.
std::string next_comparison(const Report& report);

/// "refused orders, no kicks: 3 x stale (moving); accepted at first and not fired: 1".
std::string line_of(const RefusedOrders& refused);

/// A word as a shell takes it, in quotes where it needs them.
std::string shell_word(const std::string& word);

/// What the rows of a report are counted from.
struct CountedLogs {
  const LoggedOpportunities& logged;
  const std::vector<log::RecordedSession>& sessions;
  const Arms& arms;
  const std::vector<KickerDoubt>& doubts;
};

/// The tables by policy and by robot.
struct ReportRows {
  std::vector<PolicyRow> policies;
  std::vector<RobotRow> robots;  ///< empty: there is one robot
  std::vector<int> robot_ids;    ///< of all that kicked or had the ball
};

ReportRows report_rows(const CountedLogs& logs, bool blocked_apart);

}  // namespace trivela::evaluator
