#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/model/robot_model.hpp"
#include "robot/observer/shot_tracker.hpp"

namespace trivela::robot {

/// What becomes of kicks, without a bus: receipts, the flight camera's frames and the referee's word in, outcomes out;
/// robot_id and seq of an outcome are its owner's.
class Observer {
 public:
  Observer(const config::ShotObserver& settings, const kicking::Goal& goal) : tracker_(settings, goal) {}

  /// An answered order of the robot with that model; a refused one changes nothing.
  std::vector<msg::KickOutcome> receipt(const msg::KickReceipt& receipt, const kicking::RobotModel& model);

  /// A frame and the referee's command of the same cycle; none: none came yet.
  std::vector<msg::KickOutcome> frame(const msg::FlightFrame& frame, const std::optional<msg::Referee>& referee);

  /// A kick is followed, so that frames count.
  bool follows() const { return tracker_.follows(); }

 private:
  ShotTracker tracker_;
  std::optional<std::int64_t> stopped_t_ns_;
};

}  // namespace trivela::robot
