#include "calibration/rows/drive_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "kicking/geometry/time.hpp"

namespace trivela::calibration {
namespace {

constexpr double kStill_radps = 0.3;  // turning slower than this the ball's track in the handler is straight
constexpr double kFlight_s = 2.0;
constexpr double kLeastReach_m = 0.5;   // of the goal line in front of the ball
constexpr double kCarriedBack_m = 0.3;  // between two sightings: somebody has put the ball back for the next kick

void count_out(std::vector<std::string>& left_out, std::size_t kicks, const std::string& why) {
  if (kicks > 0) left_out.push_back(fmt::format("{} {} left out: {}", kicks, kicks == 1 ? "kick" : "kicks", why));
}

/// Rows of the kicks of one drive that were seen to cross the goal line.
template <class Row>
DriveKicks<Row> rows_of(const RecordedDrives& drives, const std::string& policy,
                        const std::function<std::optional<Row>(const DriveKick&)>& row_of, const char* why_none) {
  DriveKicks<Row> result;
  std::size_t unseen = 0;
  std::size_t none = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (kick.policy != policy) continue;
    if (!kick.x_cross_m || !kick.z_cross_m) {
      ++unseen;
      continue;
    }
    auto row = row_of(kick);
    if (row) {
      result.rows.push_back(*row);
    } else {
      ++none;
    }
  }
  count_out(result.left_out, unseen, "not seen to cross the goal line");
  count_out(result.left_out, none, why_none);
  return result;
}

/// Horizontal speed along the pointing line [m/s]: V cos(theta) + k_y v_y.
double v_h_mps(const DriveKick& kick, const kicking::RobotModel& model) {
  const double v_kick_mps = model.table.speed_for(kick.power);
  return v_kick_mps * std::cos(model.exit_angle_at(kick.power)) + model.transfer_exact.along_mps(kick.twist.vy_mps);
}

std::optional<LaunchTrack> track_of(const RecordedDrives& drives, const DriveKick& kick,
                                    const kicking::RobotModel& model) {
  const auto seen = drives.sightings.find(kick.robot);
  if (seen == drives.sightings.end()) return std::nullopt;
  return launch_track(seen->second, kick.order_t_ns + kicking::nanoseconds(model.delay_s), kick.goal_line_y_m,
                      model.ball);
}

/// Line x = a + b y through the sightings between release and goal line; the direction is -atan(b), its standard error
/// from the line's own residuals. None: fewer than ten sightings or none beyond a metre.
std::optional<kicking::LaunchDirection> launch_direction(const std::vector<kicking::Sighting>& sightings,
                                                         const DriveKick& kick, const kicking::RobotModel& model) {
  constexpr double kLeft_s = 0.06;  // after the release: four standard deviations of its instant
  constexpr std::size_t kFewest = 10;
  constexpr double kLeastLength_m = 1.0;
  std::vector<Eigen::Vector2d> places;
  for (const kicking::Sighting& sighting : sightings) {
    const double t_s = kicking::seconds(sighting.t_ns - kick.order_t_ns);
    if (t_s < model.delay_s + kLeft_s) continue;
    if (t_s > kFlight_s || sighting.ball_m.y() >= kick.goal_line_y_m) break;
    if (!places.empty() && sighting.ball_m.y() < places.back().y() - kCarriedBack_m) break;
    places.emplace_back(sighting.ball_m.head<2>());
  }
  if (places.size() < kFewest || places.back().y() - places.front().y() < kLeastLength_m) return std::nullopt;
  const auto n = static_cast<double>(places.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& place : places) mean += place / n;
  double yy = 0.0, xy = 0.0, xx = 0.0;
  for (const auto& place : places) {
    const Eigen::Vector2d away = place - mean;
    yy += away.y() * away.y();
    xy += away.x() * away.y();
    xx += away.x() * away.x();
  }
  const double slope = xy / yy, residual_square = std::max(0.0, xx - slope * xy) / (n - 2.0);
  return kicking::LaunchDirection{-std::atan(slope), std::sqrt(residual_square / yy) / (1.0 + slope * slope)};
}

/// None: fewer than five sightings.
std::optional<double> low_speed_mps(const std::vector<kicking::Sighting>& sightings, const DriveKick& kick,
                                    const kicking::RobotModel& model) {
  constexpr double kLeft_s = 0.06, kSeen_s = 0.25;
  constexpr std::size_t kFewest = 5;
  std::vector<kicking::Sighting> seen;
  for (const kicking::Sighting& sighting : sightings) {
    const double t_s = kicking::seconds(sighting.t_ns - kick.order_t_ns) - model.delay_s;
    if (t_s < kLeft_s || t_s > kLeft_s + kSeen_s || sighting.ball_m.y() > kick.goal_line_y_m - kCarriedBack_m) continue;
    seen.push_back(sighting);
  }
  if (seen.size() < kFewest) return std::nullopt;
  const auto elapsed_s = [&](const kicking::Sighting& s) { return kicking::seconds(s.t_ns - kick.order_t_ns); };
  const auto track = kicking::fit_line(std::span<const kicking::Sighting>{seen}, elapsed_s,
                                       [](const kicking::Sighting& s) { return s.ball_m; });
  if (!track) return std::nullopt;
  const double v_mps = track->velocity_mps.head<2>().norm();
  const double since_s = 0.5 * (elapsed_s(seen.front()) + elapsed_s(seen.back())) - model.delay_s;
  return v_mps + kicking::drag_per_m(model.ball, {}) * v_mps * v_mps * since_s;
}

constexpr const char* kBackwards = "the robot pointed away from the goal line";

}  // namespace

DriveKicks<kicking::DeflectionRow> lateral_kicks(const RecordedDrives& drives, const kicking::RobotModel& model) {
  const auto row_of = [&](const DriveKick& kick) -> std::optional<kicking::DeflectionRow> {
    const Eigen::Vector2d crossing = kick.crossing_in_robot();
    const double distance_m = crossing.y() - model.ball_offset_m;
    if (distance_m < kLeastReach_m) return std::nullopt;
    return kicking::DeflectionRow{.vx_mps = kick.twist.vx_mps,
                                  .distance_m = distance_m,
                                  .b_m = crossing.x(),
                                  .lever_m = model.ball_offset_m,
                                  .v_h_mps = v_h_mps(kick, model)};
  };
  return rows_of<kicking::DeflectionRow>(drives, "lateral_drive", row_of, kBackwards);
}

DriveKicks<kicking::RotationRow> turn_kicks(const RecordedDrives& drives, const kicking::RobotModel& model,
                                            double cycle_s) {
  const auto row_of = [&](const DriveKick& kick) -> std::optional<kicking::RotationRow> {
    const Eigen::Vector2d crossing = kick.crossing_in_robot();
    if (crossing.y() - model.ball_offset_m < kLeastReach_m) return std::nullopt;
    const double omega = kick.twist.omega_radps;
    const double lead_rad = std::copysign(1.0, omega) * std::atan2(-crossing.x(), crossing.y());
    return kicking::RotationRow{.omega_radps = omega,
                                .allowed_error_m = crossing.y() * std::tan(lead_rad + 0.5 * std::abs(omega) * cycle_s),
                                .distance_m = crossing.y(),
                                .v_h_mps = v_h_mps(kick, model)};
  };
  return rows_of<kicking::RotationRow>(drives, "turn_drive", row_of, kBackwards);
}

DriveKicks<kicking::TransferRow> transfer_kicks(const RecordedDrives& drives, const kicking::RobotModel& model) {
  DriveKicks<kicking::TransferRow> result;
  std::size_t unseen = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (kick.policy != "straight_drive" && kick.policy != "lateral_drive") continue;
    const auto track = track_of(drives, kick, model);
    const double distance_m =
        kicking::to_robot(kick.pose, {kick.pose.x_m, kick.goal_line_y_m}).norm() - model.ball_offset_m;
    if (!track || distance_m < kLeastReach_m) {
      ++unseen;
      continue;
    }
    const Eigen::Vector2d ahead(-std::sin(kick.pose.heading_rad), std::cos(kick.pose.heading_rad));
    result.rows.push_back({.vy_mps = kick.twist.vy_mps,
                           .v0_mps = model.table.speed_for(kick.power),
                           .exit_angle_rad = model.exit_angle_at(kick.power),
                           .distance_m = distance_m,
                           .track = kicking::TrackedLaunch{.along_mps = track->velocity_mps.head<2>().dot(ahead),
                                                           .up_mps = track->velocity_mps.z(),
                                                           .weight = track->spread_s2}});
  }
  count_out(result.left_out, unseen, "the flight camera saw too little of the flight");
  return result;
}

DriveKicks<TrackedSpeed> standing_kicks(const RecordedDrives& drives, const kicking::RobotModel& model) {
  DriveKicks<TrackedSpeed> result;
  std::size_t unseen = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (kick.policy != "standing_drive") continue;
    const auto track = track_of(drives, kick, model);
    if (track) {
      const Eigen::Vector3d& velocity = track->velocity_mps;
      result.rows.push_back({kick.order_t_ns, kick.power, velocity.z(), std::atan2(velocity.x(), velocity.y())});
    } else {
      ++unseen;
    }
  }
  count_out(result.left_out, unseen, "the flight camera saw too little of the flight");
  return result;
}

DriveKicks<kicking::LaunchDirection> launch_directions(const RecordedDrives& drives, const kicking::RobotModel& model) {
  const auto& sightings = drives.sightings;
  DriveKicks<kicking::LaunchDirection> result;
  std::size_t unseen = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (kick.policy != "standing_drive") continue;
    const auto seen = sightings.find(kick.robot);
    const auto direction = seen == sightings.end() ? std::nullopt : launch_direction(seen->second, kick, model);
    if (direction) {
      result.rows.push_back(*direction);
    } else {
      ++unseen;
    }
  }
  count_out(result.left_out, unseen, "the flight camera saw too little of the flight");
  return result;
}

DriveKicks<kicking::Trial> low_kicks(const RecordedDrives& drives, const kicking::RobotModel& model) {
  DriveKicks<kicking::Trial> result;
  std::size_t unseen = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (kick.policy != "standing_drive") continue;
    const auto seen = drives.sightings.find(kick.robot);
    const auto v_mps = seen == drives.sightings.end() ? std::nullopt : low_speed_mps(seen->second, kick, model);
    const double angle_rad = model.exit_angle_at(kick.power);
    if (v_mps) {
      result.rows.push_back(
          {.power = kick.power, .exit_angle_rad = angle_rad, .exit_speed_mps = *v_mps / std::cos(angle_rad)});
    } else {
      ++unseen;
    }
  }
  count_out(result.left_out, unseen, "the flight camera saw too little of the flight");
  return result;
}

DriveKicks<double> release_delays(const RecordedDrives& drives) {
  DriveKicks<double> result;
  std::size_t turning = 0;
  std::size_t unseen = 0;
  for (const DriveKick& kick : drives.kicks) {
    if (std::abs(kick.twist.omega_radps) > kStill_radps) {
      ++turning;
      continue;
    }
    const auto seen = drives.sightings.find(kick.robot);
    const auto delay_s = seen == drives.sightings.end() ? std::nullopt : release_delay_s(seen->second, kick.order_t_ns);
    if (delay_s) {
      result.rows.push_back(*delay_s);
    } else {
      ++unseen;
    }
  }
  count_out(result.left_out, turning, "the robot turned");
  count_out(result.left_out, unseen, "the flight camera saw too little of the release");
  return result;
}

}  // namespace trivela::calibration
