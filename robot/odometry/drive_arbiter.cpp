#include "robot/odometry/drive_arbiter.hpp"

#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

/// Are two instants no farther apart, whichever is the earlier? None is so far off that it overflows.
bool instants_within(std::int64_t span_ns, std::int64_t a_ns, std::int64_t b_ns) {
  const auto a = static_cast<std::uint64_t>(a_ns), b = static_cast<std::uint64_t>(b_ns);
  return (a_ns > b_ns ? a - b : b - a) <= static_cast<std::uint64_t>(span_ns);
}

}  // namespace

DriveSituation drive_situation(const std::optional<msg::WorldState>& world, std::int64_t now_ns, double max_age_s) {
  if (!world || !instants_within(kicking::nanoseconds(max_age_s), world->t_ns, now_ns)) return {};
  return {world->playing, world->possession};
}

msg::DriveSource in_charge(config::DriveMode mode, const DriveSituation& situation, bool team_speaks) {
  switch (mode) {
    case config::DriveMode::kAlways:
      return !situation.playing && team_speaks ? msg::DRIVE_TEAM : msg::DRIVE_KICK_DECISION;
    case config::DriveMode::kWithBall:
      return situation.playing && situation.possession ? msg::DRIVE_KICK_DECISION : msg::DRIVE_TEAM;
    case config::DriveMode::kAdvice:
      break;
  }
  return msg::DRIVE_TEAM;
}

DriveArbiter::DriveArbiter(config::DriveMode mode, const config::Odometry& timeouts)
    : mode_(mode),
      own_timeout_ns_(kicking::nanoseconds(timeouts.drive_timeout_s)),
      team_timeout_ns_(kicking::nanoseconds(timeouts.team_drive_timeout_s)) {}

bool DriveArbiter::receive(msg::DriveSource source, std::int64_t t_ns, const kicking::Twist& twist,
                           std::int64_t now_ns) {
  if (!fresh(source, t_ns, now_ns)) return false;
  const bool finite = std::isfinite(twist.vx_mps) && std::isfinite(twist.vy_mps) && std::isfinite(twist.omega_radps);
  (source == msg::DRIVE_TEAM ? team_ : own_) = Received{t_ns, finite ? twist : kicking::Twist{}};
  return true;
}

bool DriveArbiter::situation_matters(std::int64_t now_ns) const {
  switch (mode_) {
    case config::DriveMode::kAlways:
      return speaks(msg::DRIVE_TEAM, now_ns);
    case config::DriveMode::kWithBall:
      return true;
    case config::DriveMode::kAdvice:
      break;
  }
  return false;
}

ObeyedDrive DriveArbiter::decide(std::int64_t now_ns, const DriveSituation& situation) const {
  const msg::DriveSource source = in_charge(mode_, situation, speaks(msg::DRIVE_TEAM, now_ns));
  if (!speaks(source, now_ns)) return {msg::DRIVE_NOBODY, {}, now_ns};
  return {source, last(source)->twist, last(source)->t_ns};
}

std::optional<double> DriveArbiter::silence_s(std::int64_t now_ns, const DriveSituation& situation) const {
  const auto& word = last(in_charge(mode_, situation, speaks(msg::DRIVE_TEAM, now_ns)));
  if (!word) return std::nullopt;
  return kicking::seconds(now_ns - word->t_ns);
}

const std::optional<DriveArbiter::Received>& DriveArbiter::last(msg::DriveSource source) const {
  return source == msg::DRIVE_TEAM ? team_ : own_;
}

bool DriveArbiter::fresh(msg::DriveSource source, std::int64_t t_ns, std::int64_t now_ns) const {
  return instants_within(source == msg::DRIVE_TEAM ? team_timeout_ns_ : own_timeout_ns_, t_ns, now_ns);
}

bool DriveArbiter::speaks(msg::DriveSource source, std::int64_t now_ns) const {
  return last(source) && fresh(source, last(source)->t_ns, now_ns);
}

}  // namespace trivela::robot
