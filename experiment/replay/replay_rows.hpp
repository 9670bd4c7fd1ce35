#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>

#include "experiment/replay/robot_logic.hpp"
#include "log/write/writer.hpp"
#include "robot/recording/message_row.hpp"

namespace trivela::experiment {

/// One robot's rows of a replay, as the recorder would write them. Waits for a disk that does not keep up.
class ReplayRows {
 public:
  /// `queue_capacity`: of the log.
  ReplayRows(log::Writer& log, std::size_t queue_capacity);

  /// The same row again.
  void write(const msg::Referee& word) { push(referee_, robot::row_of(word)); }
  void write(const msg::Odometry& odometry) { push(odometry_, robot::row_of(odometry)); }

  /// World state and drive of a cycle, its decision where the robot has the ball, and its order.
  void write_cycle(msg::WorldState world, const LogicDecision& decided);

  std::int64_t decisions() const { return decisions_made_; }
  std::int64_t orders() const { return orders_made_; }

 private:
  void push(log::TableId table, std::vector<log::Value> row);
  void write_decision(const msg::KickDecision& decision);

  log::Writer& log_;
  std::size_t most_waiting_;
  log::TableId referee_, odometry_, worlds_, drives_, decisions_, shadows_, orders_, assignments_;
  std::uint64_t cycles_ = 0;
  std::int64_t decisions_made_ = 0, orders_made_ = 0;
  std::set<std::tuple<std::uint8_t, std::uint32_t>> assigned_;  // half and possession
};

}  // namespace trivela::experiment
