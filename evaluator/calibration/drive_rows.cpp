#include "evaluator/calibration/drive_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "evaluator/calibration/release_track.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/ball_sightings.sql.hpp"
#include "evaluator/metrics/drive_kicks.sql.hpp"
#include "evaluator/report/log_sessions.hpp"
#include "kicking/geometry/frames.hpp"

namespace trivela::evaluator {
namespace {

constexpr double kStill_radps = 0.3;   // turning slower than this the ball's track in the handler is straight
constexpr double kNearFloor_m = 0.12;  // lower than this over the floor before the line, the ball has touched it
constexpr double kAirborne_s = 0.19;   // after the release every kick is higher
constexpr double kFlight_s = 2.0;
constexpr double kLeastReach_m = 0.5;   // of the goal line in front of the ball
constexpr double kCarriedBack_m = 0.3;  // between two sightings: somebody has put the ball back for the next kick

using RobotKey = std::pair<std::int64_t, std::int64_t>;  // session, robot

/// One row of drive_kicks.sql.
struct DriveKick {
  std::string policy;
  std::int64_t order_t_ns = 0;
  kicking::Pose pose;
  kicking::Twist twist;
  double goal_line_y_m = 0.0;
  double power = 0.0;
  std::optional<double> x_cross_m;
  std::optional<double> z_cross_m;
  RobotKey robot;

  /// The crossing in R as it was at the order: x to the right of the pointing line, y along it.
  Eigen::Vector2d crossing_in_robot() const { return kicking::to_robot(pose, {*x_cross_m, goal_line_y_m}); }
};

std::vector<DriveKick> all_kicks(const log::Reader& reader) {
  std::vector<DriveKick> kicks;
  SessionBook book;
  const SessionPlaces places = book.add(reader, "");
  book.settle();
  reader.query(kDriveKicksSql, [&](std::span<const log::Value> row) {
    const std::int64_t session = log::integer(row[12]);
    if (!book.counts(places.at(session), static_cast<int>(log::integer(row[13])), log::integer(row[14]))) return;
    kicks.push_back({.policy = std::get<std::string>(row[0]),
                     .order_t_ns = std::get<std::int64_t>(row[1]),
                     .pose = {log::number(row[2]), log::number(row[3]), log::number(row[4])},
                     .twist = {log::number(row[5]), log::number(row[6]), log::number(row[7])},
                     .goal_line_y_m = log::number(row[8]),
                     .power = log::number(row[9]),
                     .x_cross_m = log::number_if_any(row[10]),
                     .z_cross_m = log::number_if_any(row[11]),
                     .robot = {std::get<std::int64_t>(row[12]), std::get<std::int64_t>(row[13])}});
  });
  return kicks;
}

void count_out(std::vector<std::string>& left_out, std::size_t kicks, const std::string& why) {
  if (kicks > 0) left_out.push_back(fmt::format("{} {} left out: {}", kicks, kicks == 1 ? "kick" : "kicks", why));
}

/// Rows of the kicks of one drive that were seen to cross the goal line.
template <class Row>
DriveKicks<Row> rows_of(const log::Reader& reader, const std::string& policy,
                        const std::function<std::optional<Row>(const DriveKick&)>& row_of, const char* why_none) {
  DriveKicks<Row> result;
  std::size_t unseen = 0;
  std::size_t none = 0;
  for (const DriveKick& kick : all_kicks(reader)) {
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

using SightingsByRobot = std::map<RobotKey, std::vector<BallSighting>>;

SightingsByRobot all_sightings(const log::Reader& reader) {
  SightingsByRobot sightings;
  reader.query(kBallSightingsSql, [&](std::span<const log::Value> row) {
    sightings[{std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1])}].push_back(
        {std::get<std::int64_t>(row[2]), {log::number(row[3]), log::number(row[4]), log::number(row[5])}});
  });
  return sightings;
}

/// Was the ball seen near the floor on its way to the goal line?
bool touched_floor(const std::vector<BallSighting>& sightings, const DriveKick& kick,
                   const kicking::RobotModel& model) {
  for (const BallSighting& sighting : sightings) {
    const double t_s = 1e-9 * static_cast<double>(sighting.t_ns - kick.order_t_ns);
    if (t_s < model.delay_s + kAirborne_s) continue;
    if (t_s > kFlight_s || sighting.ball_m.y() >= kick.goal_line_y_m) return false;
    if (sighting.ball_m.z() < model.ball.radius_m + kNearFloor_m) return true;
  }
  return false;
}

/// Vertical speed at the launch height of the flight that was seen [m/s]: sqrt(v_z^2 + 2 g (z - r)), from the free fall
/// fitted to every sighting before the goal line. It is the kicker's own: the robot's motion adds nothing to it. None:
/// fewer than ten sightings.
std::optional<double> launch_v_z_mps(const std::vector<BallSighting>& sightings, const DriveKick& kick,
                                     const kicking::RobotModel& model) {
  constexpr double kLeft_s = 0.06;  // after the release: four standard deviations of its instant
  constexpr double kFewest = 10.0;
  constexpr double g = kicking::kGravity_mps2;
  double n = 0.0, t = 0.0, z = 0.0, tt = 0.0, tz = 0.0, farthest_y_m = -HUGE_VAL;
  for (const BallSighting& sighting : sightings) {
    const double t_s = 1e-9 * static_cast<double>(sighting.t_ns - kick.order_t_ns);
    if (t_s < model.delay_s + kLeft_s) continue;
    if (t_s > kFlight_s || sighting.ball_m.y() >= kick.goal_line_y_m) break;
    if (sighting.ball_m.y() < farthest_y_m - kCarriedBack_m) break;
    farthest_y_m = std::max(farthest_y_m, sighting.ball_m.y());
    const double straight_m = sighting.ball_m.z() + 0.5 * g * t_s * t_s;  // without gravity a line
    n += 1.0;
    t += t_s;
    z += straight_m;
    tt += t_s * t_s;
    tz += t_s * straight_m;
  }
  if (n < kFewest) return std::nullopt;
  const double slope_mps = (n * tz - t * z) / (n * tt - t * t), middle_s = t / n;
  const double v_z_mps = slope_mps - g * middle_s, z_m = z / n - 0.5 * g * middle_s * middle_s;
  const double squared = v_z_mps * v_z_mps + 2.0 * g * (z_m - model.ball.radius_m);
  return squared > 0.0 ? std::optional{std::sqrt(squared)} : std::nullopt;
}

/// Line x = a + b y through the sightings between release and goal line; the direction is -atan(b), its standard error
/// from the line's own residuals. None: fewer than ten sightings or none beyond a metre.
std::optional<kicking::LaunchDirection> launch_direction(const std::vector<BallSighting>& sightings,
                                                         const DriveKick& kick, const kicking::RobotModel& model) {
  constexpr double kLeft_s = 0.06;  // after the release: four standard deviations of its instant
  constexpr std::size_t kFewest = 10;
  constexpr double kLeastLength_m = 1.0;
  std::vector<Eigen::Vector2d> places;
  for (const BallSighting& sighting : sightings) {
    const double t_s = 1e-9 * static_cast<double>(sighting.t_ns - kick.order_t_ns);
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

constexpr const char* kBackwards = "the robot pointed away from the goal line";

}  // namespace

DriveKicks<kicking::DeflectionRow> lateral_kicks(const log::Reader& reader, const kicking::RobotModel& model) {
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
  return rows_of<kicking::DeflectionRow>(reader, "lateral_drive", row_of, kBackwards);
}

DriveKicks<kicking::RotationRow> turn_kicks(const log::Reader& reader, const kicking::RobotModel& model,
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
  return rows_of<kicking::RotationRow>(reader, "turn_drive", row_of, kBackwards);
}

DriveKicks<kicking::TransferRow> straight_kicks(const log::Reader& reader, const kicking::RobotModel& model) {
  const SightingsByRobot sightings = all_sightings(reader);
  const auto row_of = [&](const DriveKick& kick) -> std::optional<kicking::TransferRow> {
    const double distance_m = kick.crossing_in_robot().y() - model.ball_offset_m;
    const auto seen = sightings.find(kick.robot);
    const bool bounced = seen != sightings.end() && touched_floor(seen->second, kick, model);
    if (distance_m < kLeastReach_m || bounced || *kick.z_cross_m < model.ball.radius_m + kNearFloor_m) {
      return std::nullopt;
    }
    const double exit_angle_rad = model.exit_angle_at(kick.power);
    const auto v_z_mps = seen == sightings.end() ? std::nullopt : launch_v_z_mps(seen->second, kick, model);
    if (!v_z_mps) return std::nullopt;
    return kicking::TransferRow{.vy_mps = kick.twist.vy_mps,
                                .v0_mps = *v_z_mps / std::sin(exit_angle_rad),
                                .exit_angle_rad = exit_angle_rad,
                                .distance_m = distance_m,
                                .z_cross_m = *kick.z_cross_m};
  };
  return rows_of<kicking::TransferRow>(
      reader, "straight_drive", row_of,
      "the ball touched the floor before the goal line or was seen fewer than ten times, or the robot pointed away");
}

DriveKicks<kicking::LaunchDirection> launch_directions(const log::Reader& reader, const kicking::RobotModel& model) {
  const SightingsByRobot sightings = all_sightings(reader);
  DriveKicks<kicking::LaunchDirection> result;
  std::size_t unseen = 0;
  for (const DriveKick& kick : all_kicks(reader)) {
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

DriveKicks<double> release_delays(const log::Reader& reader) {
  SightingsByRobot sightings = all_sightings(reader);
  DriveKicks<double> result;
  std::size_t turning = 0;
  std::size_t unseen = 0;
  for (const DriveKick& kick : all_kicks(reader)) {
    if (std::abs(kick.twist.omega_radps) > kStill_radps) {
      ++turning;
    } else if (const auto delay_s = release_delay_s(sightings[kick.robot], kick.order_t_ns)) {
      result.rows.push_back(*delay_s);
    } else {
      ++unseen;
    }
  }
  count_out(result.left_out, turning, "the robot turned");
  count_out(result.left_out, unseen, "the flight camera saw too little of the release");
  return result;
}

}  // namespace trivela::evaluator
