#include "experiment/replay/replay_rows.hpp"

#include <utility>

namespace trivela::experiment {
namespace {

template <class T>
log::TableId table(log::Writer& log) {
  return log.table(robot::table_of<T>(), robot::columns_of<T>());
}

}  // namespace

ReplayRows::ReplayRows(log::Writer& log, std::size_t queue_capacity)
    : log_(log),
      most_waiting_(queue_capacity / 2),
      referee_(table<msg::Referee>(log)),
      odometry_(table<msg::Odometry>(log)),
      worlds_(table<msg::WorldState>(log)),
      drives_(table<msg::DriveCommand>(log)),
      decisions_(table<msg::KickDecision>(log)),
      shadows_(log.table(robot::table_of<msg::ShadowDecision>(), robot::shadow_columns())),
      orders_(table<msg::KickOrder>(log)),
      assignments_(log.table("assignments", robot::assignment_columns())) {}

void ReplayRows::push(log::TableId table, std::vector<log::Value> row) {
  if (log_.waiting() > most_waiting_) log_.flush();
  log_.push(table, std::move(row));
}

void ReplayRows::write_cycle(msg::WorldState world, const LogicDecision& decided) {
  world.seq = ++cycles_;
  push(worlds_, robot::row_of(world));
  push(drives_, robot::row_of(msg::DriveCommand{.robot_id = world.robot_id,
                                                .seq = cycles_,
                                                .t_ns = world.t_ns,
                                                .vx_mps = decided.drive.vx_mps,
                                                .vy_mps = decided.drive.vy_mps,
                                                .omega_radps = decided.drive.omega_radps,
                                                .lever_kind = decided.record.lever_kind}));
  if (world.possession) write_decision(decided.record);
  if (!decided.order) return;
  ++orders_made_;
  push(orders_, robot::row_of(*decided.order));
}

void ReplayRows::write_decision(const msg::KickDecision& decision) {
  ++decisions_made_;
  push(decisions_, robot::row_of(decision));
  if (decision.reason != msg::REASON_NOT_PLAYING && assigned_.emplace(decision.half, decision.possession_id).second) {
    robot::RowCells row;
    robot::write_assignment(row, decision.robot_id, decision.half, decision.possession_id, msg::policy_name(decision),
                            decision.assignment_probability, decision.t_ns);
    push(assignments_, std::move(row.cells));
  }
  for (std::int64_t i = 0; i < decision.shadow_count; ++i) {
    robot::RowCells row;
    robot::write_shadow(row, decision.robot_id, static_cast<std::int64_t>(decision.seq), i, decision.shadows[i]);
    push(shadows_, std::move(row.cells));
  }
}

}  // namespace trivela::experiment
