#include "experiment/run/record_match.hpp"

#include "robot/recording/message_row.hpp"

namespace trivela::experiment {
namespace {

template <class T>
std::size_t add_table(log::ExperimentLog& log) {
  return log.table(robot::table_of<T>(), robot::columns_of<T>());
}

}  // namespace

MatchTables::MatchTables(log::ExperimentLog& log)
    : log_(log),
      referee_(add_table<msg::Referee>(log)),
      decisions_(add_table<msg::KickDecision>(log)),
      shadows_(log.table(robot::table_of<msg::ShadowDecision>(), robot::shadow_columns())),
      orders_(add_table<msg::KickOrder>(log)),
      receipts_(add_table<msg::KickReceipt>(log)),
      outcomes_(add_table<msg::KickOutcome>(log)),
      estimates_(add_table<msg::KickerEstimate>(log)),
      kick_truths_(add_table<msg::KickTruth>(log)),
      possession_truths_(add_table<msg::PossessionTruth>(log)),
      assignments_(log.table("assignments", robot::assignment_columns())) {}

template <class T>
void MatchTables::write(std::size_t table, const std::vector<T>& messages, std::int64_t session_id) {
  for (const T& message : messages) {
    robot::write_cells(log_.row(table, session_id), message);
    log_.end_row();
  }
}

void MatchTables::write_shadows(const msg::KickDecision& decision, std::int64_t session_id) {
  for (std::int64_t i = 0; i < decision.shadow_count; ++i) {
    robot::write_shadow(log_.row(shadows_, session_id), decision.robot_id, static_cast<std::int64_t>(decision.seq), i,
                        decision.shadows[i]);
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
  write(estimates_, record.estimates, session_id);
  write(kick_truths_, record.kick_truths, session_id);
  write(possession_truths_, record.possession_truths, session_id);
  for (const Assignment& assignment : record.assignments) {
    robot::write_assignment(log_.row(assignments_, session_id), assignment.robot_id, assignment.half,
                            assignment.possession_id, kicking::name(assignment.policy), assignment.probability,
                            assignment.t_ns);
    log_.end_row();
  }
}

}  // namespace trivela::experiment
