#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "experiment/replay/recorded_cycles.hpp"
#include "log/write/writer.hpp"

namespace trivela::experiment {

/// What a robot decides by.
struct RobotSetup {
  config::Settings settings;
  config::Robot robot;
};

/// Told now and then how many seconds of a robot's recording have been decided; false: it shall stop.
using ReplayProgress = std::function<bool(double done_s)>;

/// Decides the recorded cycles of a robot again, in process and open loop: wheels, cameras, referee and kicker say what
/// they said, whatever is ordered. `recorded` is the setup of the log, `other` another one; none: the same.
/// `queue_capacity`: of `log`. The rows of world states, decisions, orders, drives and of the referee go to `log`, of
/// the wheel odometry too where base or noise are other ones. The kicks of the log have no receipts: nobody was asked
/// to fire them. Returns how far the log's own setup gives again what was recorded. Throws config::Error where the
/// policies make no sense together, std::runtime_error where a log cannot be read or written.
ReplayCheck replay_robot(const RecordedRobot& robot, const RobotSetup& recorded, const std::optional<RobotSetup>& other,
                         log::Writer& log, std::size_t queue_capacity, const ReplayProgress& progress = {});

}  // namespace trivela::experiment
