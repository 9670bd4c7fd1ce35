#pragma once

#include <cstdint>
#include <optional>

#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "kicking/geometry/frames.hpp"

namespace trivela::robot {

/// What decides whose commands count. Of a robot that knows nothing, the game is on and the ball elsewhere.
struct DriveSituation {
  bool playing = true;
  bool possession = false;
};

/// The situation of a belief; one that is none, or farther than `max_age_s` from now_ns, says nothing.
DriveSituation drive_situation(const std::optional<msg::WorldState>& world, std::int64_t now_ns, double max_age_s);

/// Who drives in this situation, heard or not: kick_decision always, with the ball while the game is on, or never; the
/// team's own program otherwise. While the game stands kick_decision has nowhere to go: then the team's commands count
/// in every mode, where there are any (`team_speaks`).
msg::DriveSource in_charge(config::DriveMode mode, const DriveSituation& situation, bool team_speaks);

/// What the wheels are told.
struct ObeyedDrive {
  msg::DriveSource source = msg::DRIVE_NOBODY;
  kicking::Twist twist{};  ///< in R; nobody's is standstill
  std::int64_t t_ns = 0;   ///< that it answers
};

/// Decides between the commands of kick_decision and of the team's own program. A command counts for its source's
/// timeout from its own instant on; when the one in charge is silent for longer, the robot stands, whatever the other
/// one says.
class DriveArbiter {
 public:
  DriveArbiter(config::DriveMode mode, const config::Odometry& timeouts);

  /// A command of the instant t_ns by one of the two; one that is not finite is standstill. False: it is none, since
  /// t_ns is farther from now_ns than the timeout; the one before goes on.
  bool receive(msg::DriveSource source, std::int64_t t_ns, const kicking::Twist& twist, std::int64_t now_ns);

  /// Does in_charge() depend on the situation now?
  bool situation_matters(std::int64_t now_ns) const;

  ObeyedDrive decide(std::int64_t now_ns, const DriveSituation& situation) const;

  /// How long the one in charge has been silent [s]; none: it never said anything.
  std::optional<double> silence_s(std::int64_t now_ns, const DriveSituation& situation) const;

 private:
  struct Received {
    std::int64_t t_ns = 0;
    kicking::Twist twist{};
  };

  const std::optional<Received>& last(msg::DriveSource source) const;
  bool fresh(msg::DriveSource source, std::int64_t t_ns, std::int64_t now_ns) const;
  bool speaks(msg::DriveSource source, std::int64_t now_ns) const;

  config::DriveMode mode_;
  std::int64_t own_timeout_ns_;
  std::int64_t team_timeout_ns_;
  std::optional<Received> own_, team_;
};

}  // namespace trivela::robot
