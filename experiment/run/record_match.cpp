#include "experiment/run/record_match.hpp"

#include "robot/recording/message_row.hpp"

namespace trivela::experiment {
namespace {

using evaluator::log::RowSink;

template <class T>
void fill(RowSink& row, const T& message) {
  bus::visit_fields(message, [&](std::string_view, std::string_view, const auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (bus::Enumeration<Field>) {
      row.text(bus::label(field));
    } else if constexpr (std::is_floating_point_v<Field>) {
      row.number(static_cast<double>(field));
    } else if constexpr (!robot::kIsNested<Field>) {
      row.integer(static_cast<std::int64_t>(field));
    }
  });
}

template <class T>
std::size_t table_of(evaluator::log::ExperimentLog& log, const char* name) {
  return log.table(name, robot::columns_of<T>());
}

std::vector<std::string> shadow_columns() {
  std::vector<std::string> columns{"robot_id", "seq", "shadow_index"};
  for (const std::string& column : robot::columns_of<msg::ShadowDecision>()) columns.push_back(column);
  return columns;
}

}  // namespace

MatchTables::MatchTables(evaluator::log::ExperimentLog& log)
    : log_(log),
      referee_(table_of<msg::Referee>(log, "referee")),
      decisions_(table_of<msg::KickDecision>(log, "kick_decisions")),
      shadows_(log.table("shadow_decisions", shadow_columns())),
      orders_(table_of<msg::KickOrder>(log, "kick_orders")),
      receipts_(table_of<msg::KickReceipt>(log, "kick_receipts")),
      outcomes_(table_of<msg::KickOutcome>(log, "kick_outcomes")),
      kick_truths_(table_of<msg::KickTruth>(log, "kick_truths")),
      possession_truths_(table_of<msg::PossessionTruth>(log, "possession_truths")),
      assignments_(log.table("assignments", {"robot_id", "half", "possession_id", "policy", "probability"})) {}

template <class T>
void MatchTables::write(std::size_t table, const std::vector<T>& messages, std::int64_t session_id) {
  for (const T& message : messages) {
    fill(log_.row(table, session_id), message);
    log_.end_row();
  }
}

void MatchTables::write_shadows(const msg::KickDecision& decision, std::int64_t session_id) {
  for (std::int64_t i = 0; i < decision.shadow_count; ++i) {
    RowSink& row = log_.row(shadows_, session_id);
    row.integer(decision.robot_id);
    row.integer(static_cast<std::int64_t>(decision.seq));
    row.integer(i);
    fill(row, decision.shadows[i]);
    log_.end_row();
  }
}

void MatchTables::write(const MatchRecord& record, std::int64_t session_id) {
  write(referee_, record.referee, session_id);
  write(decisions_, record.decisions, session_id);
  for (const msg::KickDecision& decision : record.decisions) write_shadows(decision, session_id);
  write(orders_, record.orders, session_id);
  write(receipts_, record.receipts, session_id);
  write(outcomes_, record.outcomes, session_id);
  write(kick_truths_, record.kick_truths, session_id);
  write(possession_truths_, record.possession_truths, session_id);
  for (const Assignment& assignment : record.assignments) {
    RowSink& row = log_.row(assignments_, session_id);
    row.integer(assignment.robot_id);
    row.integer(assignment.half);
    row.integer(assignment.possession_id);
    row.text(kicking::name(assignment.policy));
    row.number(assignment.probability);
    log_.end_row();
  }
}

}  // namespace trivela::experiment
