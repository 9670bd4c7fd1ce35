#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/counting/arms.hpp"
#include "evaluator/counting/kick_counts.hpp"
#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/render/gate.hpp"
#include "evaluator/sessions/kicker_learning.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/sessions/recording_gaps.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "evaluator/stats/counts/interval.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// Reasons why a kick was not on target, as in kicking::Outcome, without kUnknown. A label by hand may be "outside"
/// without any of them.
inline const std::vector<std::string> kMisses = {"wide_left", "wide_right", "over", "short", "post", "bar", "blocked"};

/// One row of Table 2: the kicks of a policy, of an experiment those of an arm with it.
struct PolicyRow : KickCounts {
  std::string arm;           ///< Arm::name; empty: none
  bool beside_arms = false;  ///< it has none, and other rows have
  std::string policy;
  std::int64_t repeated = 0;                 ///< kicks in situations that it had in an earlier, paired half
  std::optional<stats::Interval> paired_ci;  ///< of the efficiency, where some are repeated; none: Wilson's holds

  /// Of the efficiency, 95 %: Wilson's, by situations where paired halves repeat some.
  stats::Interval efficiency_ci() const { return paired_ci.value_or(stats::wilson(counts())); }
};

/// The kicks of a robot with a policy.
struct RobotRow : PolicyRow {
  int robot_id = 0;
};

/// A decision that fired and that order, receipt or outcome is missing of.
struct UnclosedKick {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;
  std::string policy;
  bool has_order = false;
  bool has_receipt = false;
  bool has_outcome = false;
};

struct RefusedOrders {
  std::string policy;
  std::string refusal;
  std::int64_t orders = 0;
  std::int64_t not_fired = 0;  ///< of them, accepted at first
};

/// Table 2 of match logs, their sessions pooled by policy or arm, and how far it can be trusted.
struct Report {
  std::vector<std::string> logs;  ///< their names
  std::vector<log::RecordedSession> sessions;
  std::vector<SessionNote> notes;   ///< what people say of them, as far as it holds
  std::vector<Arm> arms;            ///< of experiments, whose sessions are not named one by one
  std::vector<PolicyRow> policies;  ///< by arm, and in the order of PolicyOrder
  std::vector<RobotRow> robots;     ///< by robot, arm and policy; empty: there is one robot
  std::vector<int> robot_ids;       ///< of all that kicked or had the ball; 0: one that an import does not know
  std::vector<PlayedLength> lengths;
  ImportNotes imports{};                 ///< of sessions that no robot recorded
  std::vector<std::string> not_counted;  ///< sentences on what does not count, or not twice, or stands apart
  std::vector<log::Loss> losses;         ///< by stream
  std::vector<UnclosedKick> unclosed_kicks;
  std::vector<RefusedOrders> refused_orders;
  std::vector<RecordedSilence> silences;
  std::vector<UnrecordedOrders> unrecorded_orders;
  LabelQuality labels;
  std::vector<LearnedKicker> kickers;  ///< what robots learned of their kickers
  HandLabels hand_labels;
  std::vector<std::string> goal_warnings;  ///< sentences on where the goal is, also among `warnings`
  std::vector<std::string> warnings;       ///< sentences on unclosed sessions, lost rows, unfinished experiments
  std::optional<std::string> doubt;        ///< a sentence on rows that nobody compared with their digest
  std::int64_t verified_rows = 0;          ///< that are as they were recorded
  std::int64_t compared_with_truth = 0;    ///< kicks whose outcome and truth are both known
  std::int64_t alike_with_truth = 0;

  std::vector<GateResult> gates;  ///< of whoever asked (judge_gates())

  /// A keeper saved something, or people say what were goals.
  bool keeper() const;

  std::int64_t rows_missing() const;
  std::int64_t unclosed_sessions() const;
  std::int64_t simulated_sessions() const;

  /// Rows are missing, or may be since a session was not closed; a stream was silent, kicks stand in no log, or the
  /// match was cut short.
  bool data_lost() const;
};

/// Counts what is in the logs, each kick once. `blocked_apart`: blocked kicks stand apart, efficiency is of the others;
/// otherwise they are outside, as in the paper's Table 2. Throws std::runtime_error where a log cannot be read.
Report make_report(std::span<const OpenLog> logs, bool blocked_apart = false);

/// Aligned tables for a terminal: Table 2, why the misses missed, data quality.
std::string to_text(const Report& report);

/// The same tables in Markdown (GitHub's), and in LaTeX for \input; names are harmless in either.
std::string to_markdown(const Report& report);
std::string to_latex(const Report& report);

/// A line for each policy, robot, and number of the data quality, told apart by the column `row`; a number that belongs
/// to no policy has its `name` and `value`. A cell is empty where there is no such number.
std::string to_csv(const Report& report);

/// `policies: [{policy, inside, outside, efficiency, wilson95, ...}]`, `sessions`, `data_quality` and notes.
/// null where there is no such number.
std::string to_json(const Report& report);

}  // namespace trivela::evaluator
