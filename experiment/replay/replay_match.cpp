#include "experiment/replay/replay_match.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "hal/wheels.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/optional_double.hpp"
#include "robot/odometry/wheel_odometry.hpp"
#include "robot/recording/message_row.hpp"

namespace trivela::experiment {
namespace {

template <class T>
log::TableId table(log::Writer& log) {
  return log.table(robot::table_of<T>(), robot::columns_of<T>());
}

/// One robot's rows of a replay, as the recorder would write them. Waits for a disk that does not keep up.
class ReplayRows {
 public:
  /// `queue_capacity`: of the log.
  ReplayRows(log::Writer& log, std::size_t queue_capacity)
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

  /// The same row again.
  void write(const msg::Referee& word) { push(referee_, robot::row_of(word)); }
  void write(const msg::Odometry& odometry) { push(odometry_, robot::row_of(odometry)); }

  /// World state and drive of a cycle, its decision where the robot has the ball, and its order.
  void write_cycle(msg::WorldState world, const LogicDecision& decided) {
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
    if (decided.order) push(orders_, robot::row_of(*decided.order));
  }

 private:
  void push(log::TableId table, std::vector<log::Value> row) {
    if (log_.waiting() > most_waiting_) log_.flush();
    log_.push(table, std::move(row));
  }

  void write_decision(const msg::KickDecision& decision) {
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

  log::Writer& log_;
  std::size_t most_waiting_;
  log::TableId referee_, odometry_, worlds_, drives_, decisions_, shadows_, orders_, assignments_;
  std::uint64_t cycles_ = 0;
  std::set<std::tuple<std::uint8_t, std::uint32_t>> assigned_;  // half and possession
};

void refuse_oracle(const config::KickDecision& settings, int robot_id) {
  const robot::PolicyAssignment assignment{settings, static_cast<std::uint8_t>(robot_id)};
  for (const kicking::PolicyName policy : assignment.candidates()) {
    if (!facts(policy).needs_truth()) continue;
    throw std::runtime_error{fmt::format("the policy {} needs the simulator's true state, which no recorded stream has",
                                         kicking::name(policy))};
  }
}

/// The kick session of the robot's first recorded order, so that the same orders have the same numbers; else 1.
std::uint32_t kick_session(const RecordedRobot& robot) {
  std::uint32_t session = 1;
  robot.reader.query(
      fmt::format(
          "SELECT kick_id FROM kick_decisions WHERE session_id = {} AND robot_id = {} AND fire = 1 ORDER BY seq "
          "LIMIT 1",
          robot.session_id, robot.robot_id),
      [&](std::int64_t kick_id) { session = kicking::KickId::of(kick_id).session; });
  return session;
}

hal::WheelSample wheel_sample(const msg::Odometry& odometry) {
  hal::WheelSample sample{
      .t_ns = odometry.t_ns, .wheel_count = 0, .wheel_radps = {}, .gyro_radps = odometry.gyro_radps};
  for (const kicking::OptionalDouble speed_radps :
       {odometry.wheel_0_radps, odometry.wheel_1_radps, odometry.wheel_2_radps, odometry.wheel_3_radps}) {
    if (!speed_radps) break;
    sample.wheel_radps[static_cast<std::size_t>(sample.wheel_count++)] = *speed_radps;
  }
  return sample;
}

/// The robot as another setup has it.
class OtherRobot {
 public:
  OtherRobot(const RobotSetup& setup, const RobotSetup& recorded, const RecordedRobot& robot)
      : logic_(setup.settings, setup.robot, static_cast<std::uint8_t>(robot.robot_id), kick_session(robot)) {
    if (setup.robot.base != recorded.robot.base || setup.settings.odometry != recorded.settings.odometry)
      odometry_.emplace(setup.robot.base, setup.settings.odometry);
  }

  bool has_odometry() const { return odometry_.has_value(); }

  /// The wheel odometry of a recorded sample; none: it does not go with this base.
  std::optional<msg::Odometry> odometry(const msg::Odometry& recorded) {
    if (!odometry_) return recorded;
    const msg::Odometry* const estimate = odometry_->update(wheel_sample(recorded));
    if (estimate == nullptr) return std::nullopt;
    msg::Odometry made = *estimate;
    made.robot_id = recorded.robot_id;
    made.seq = recorded.seq;
    made.obeyed = recorded.obeyed;
    return made;
  }

  RobotLogic& logic() { return logic_; }

 private:
  RobotLogic logic_;
  std::optional<robot::WheelOdometry> odometry_;
};

}  // namespace

ReplayCheck replay_robot(const RecordedRobot& robot, const RobotSetup& recorded, const std::optional<RobotSetup>& other,
                         log::Writer& log, std::size_t queue_capacity, const ReplayProgress& progress) {
  refuse_oracle((other ? *other : recorded).settings.kick_decision, robot.robot_id);
  RecordedCycles cycles{robot, recorded.settings, recorded.robot, kick_session(robot)};
  std::optional<OtherRobot> changed;
  if (other) changed.emplace(*other, recorded, robot);
  ReplayRows rows{log, queue_capacity};
  for (RowPages<msg::Referee> words{robot}; const auto word = words.next();) rows.write(*word);
  std::optional<std::int64_t> first_t_ns;
  std::int64_t samples = 0, of_another_base = 0;
  while (cycles.next()) {
    first_t_ns = first_t_ns.value_or(cycles.odometry().t_ns);
    if (progress && ++samples % 256 == 0 && !progress(kicking::seconds(cycles.odometry().t_ns - *first_t_ns))) break;
    if (!changed) {
      rows.write_cycle(cycles.world(), cycles.decided());
    } else if (const auto odometry = changed->odometry(cycles.odometry())) {
      if (changed->has_odometry()) rows.write(*odometry);
      const msg::WorldState world = changed->logic().believe(*odometry, cycles.belief_inputs());
      rows.write_cycle(world, changed->logic().decide(world, cycles.decision_inputs()));
    } else {
      ++of_another_base;
    }
  }
  if (of_another_base > 0 && of_another_base == cycles.check().cycles)
    throw std::runtime_error{
        fmt::format("robot {}: none of its {} wheel samples goes with the robot's file: it has {} wheels",
                    robot.robot_id, of_another_base, other->robot.base.wheel_angles_rad.size())};
  return cycles.check();
}

}  // namespace trivela::experiment
