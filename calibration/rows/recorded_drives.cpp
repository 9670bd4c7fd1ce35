#include "calibration/rows/recorded_drives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/rows/ball_sightings.sql.hpp"
#include "calibration/rows/drive_kicks.sql.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::calibration {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr double kHeld_s = 0.2;
constexpr double kTrack_s = 0.5;
constexpr double kAway_m = 0.25;  // eight standard deviations of a sighting: the ball has left
constexpr std::size_t kFewest = 5;
constexpr std::size_t kMostInFlight = 8;

/// Least squares of p(t) = position + velocity (t - slowing (t - t_0)^2 / 2), t after the order, t_0 that of the first.
std::optional<kicking::FlightState> fit_track(std::span<const kicking::Sighting> sightings, std::int64_t order_t_ns,
                                              double slowing_hz) {
  const auto elapsed_s = [&](const kicking::Sighting& s) {
    const double after_s = kicking::seconds(order_t_ns, s.t_ns);
    const double t_s = after_s - kicking::seconds(order_t_ns, sightings.front().t_ns);
    return after_s - 0.5 * slowing_hz * t_s * t_s;
  };
  return kicking::fit_line(sightings, elapsed_s, [](const kicking::Sighting& s) { return s.ball_m; });
}

}  // namespace

RecordedDrives recorded_drives(const log::Reader& reader) {
  RecordedDrives result;
  evaluator::SessionIndex sessions_read;
  const evaluator::SessionPlaces places = sessions_read.add(reader, "");
  sessions_read.settle();
  reader.query(kDriveKicksSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto robot_id = row.get<int>("robot_id");
    if (!sessions_read.counts(places.at(session_id), robot_id, row.get<std::int64_t>("kick_id"))) return;
    result.kicks.push_back(
        {.policy = row.get<std::string>("policy"),
         .order_t_ns = row.get<std::int64_t>("order_t_ns"),
         .pose = {row.get<double>("x_m"), row.get<double>("y_m"), row.get<double>("heading_rad")},
         .twist = {row.get<double>("vx_mps"), row.get<double>("vy_mps"), row.get<double>("omega_radps")},
         .goal_line_y_m = row.get<double>("goal_line_y_m"),
         .power = row.get<double>("power"),
         .x_cross_m = row.find<double>("x_cross_m"),
         .z_cross_m = row.find<double>("z_cross_m"),
         .robot = {session_id, robot_id}});
  });
  reader.query(kBallSightingsSql, [&](std::int64_t session_id, std::int64_t robot_id, std::int64_t t_exposure_ns,
                                      std::optional<double> x_m, std::optional<double> y_m, std::optional<double> z_m) {
    result.sightings[{session_id, robot_id}].push_back(
        {t_exposure_ns, {x_m.value_or(kNaN), y_m.value_or(kNaN), z_m.value_or(kNaN)}});
  });
  return result;
}

std::optional<double> release_delay_s(std::span<const kicking::Sighting> sightings, std::int64_t order_t_ns) {
  std::vector<kicking::Sighting> held, after;
  for (const kicking::Sighting& sighting : sightings) {
    const double t_s = kicking::seconds(order_t_ns, sighting.t_ns);
    if (t_s >= -kHeld_s && t_s <= 0.0) held.push_back(sighting);
    if (t_s > 0.0 && t_s <= kTrack_s) after.push_back(sighting);
  }
  if (held.size() < kFewest) return std::nullopt;
  const auto handler = fit_track(held, order_t_ns, 0.0);
  if (!handler) return std::nullopt;
  const auto gone = [&](const kicking::Sighting& seen) {
    const double t_s = kicking::seconds(order_t_ns, seen.t_ns);
    return (seen.ball_m - handler->position_m - handler->velocity_mps * t_s).head<2>().norm() > kAway_m;
  };
  const auto first = std::ranges::find_if(after, gone);
  const auto left = static_cast<std::size_t>(after.end() - first);
  if (left < kFewest) return std::nullopt;
  const std::span<const kicking::Sighting> flight(first, std::min(left, kMostInFlight));
  auto ball = fit_track(flight, order_t_ns, 0.0);
  if (ball) ball = fit_track(flight, order_t_ns, kicking::drag_per_m({}, {}) * ball->velocity_mps.norm());
  if (!ball) return std::nullopt;

  // Backwards from the first place the drag is neglected: within 0.05 s it is a millimetre.
  const Eigen::Vector2d apart_m = (handler->position_m - ball->position_m).head<2>();
  const Eigen::Vector2d closing_mps = (ball->velocity_mps - handler->velocity_mps).head<2>();
  const double squared = closing_mps.squaredNorm();
  if (!(squared > 0.0)) return std::nullopt;
  return apart_m.dot(closing_mps) / squared;
}

namespace {

using Eigen::Vector3d;
using kicking::drag_acceleration;
using kicking::FlightState;

constexpr double kTrackBegin_s = 0.06;  // after the release: four standard deviations of its instant
constexpr double kTrackEnd_s = 2.0;
constexpr double kTrackFloor_m = 0.12;  // lower than this over its radius, on its way down, the ball may have touched
constexpr double kTrackGoal_m = 0.4;    // before the goal line: post and bar throw the ball back, the camera scatters
constexpr double kTrackBack_m = 0.3;    // between two sightings: somebody has put the ball back for the next kick
constexpr std::size_t kFewestOfTrack = 10;
constexpr double kTrackStep_s = 0.01;

struct SeenBall {
  double t_s;  ///< after the release
  Vector3d ball_m;
};

/// One step of the midpoint rule; a flight of a second is right to 1e-5 m.
FlightState one_step(const FlightState& s, double dt_s, double drag_per_m) {
  const Vector3d middle = s.velocity_mps + 0.5 * dt_s * drag_acceleration(s.velocity_mps, drag_per_m);
  return {s.position_m + dt_s * middle, s.velocity_mps + dt_s * drag_acceleration(middle, drag_per_m)};
}

FlightState flown(FlightState s, double for_s, double drag_per_m) {
  const double steps = std::max(1.0, std::ceil(std::abs(for_s) / kTrackStep_s));
  for (double i = 0.0; i < steps; i += 1.0) s = one_step(s, for_s / steps, drag_per_m);
  return s;
}

std::vector<SeenBall> in_flight(std::span<const kicking::Sighting> sightings, std::int64_t release_t_ns,
                                double goal_line_y_m, double radius_m) {
  std::vector<SeenBall> seen;
  const auto from = std::ranges::lower_bound(sightings, release_t_ns, {}, &kicking::Sighting::t_ns);
  for (auto sighting = from; sighting != sightings.end(); ++sighting) {
    const double t_s = kicking::seconds(sighting->t_ns - release_t_ns);
    const Vector3d& ball_m = sighting->ball_m;
    if (t_s < kTrackBegin_s) continue;
    if (t_s > kTrackEnd_s || ball_m.y() >= goal_line_y_m - kTrackGoal_m) break;
    if (!seen.empty() && ball_m.y() < seen.back().ball_m.y() - kTrackBack_m) break;
    if (t_s > 4.0 * kTrackBegin_s && ball_m.z() < radius_m + kTrackFloor_m) break;
    seen.push_back({t_s, ball_m});
  }
  return seen;
}

}  // namespace

std::optional<LaunchTrack> launch_track(std::span<const kicking::Sighting> sightings, std::int64_t release_t_ns,
                                        double goal_line_y_m, const kicking::Ball& ball) {
  const std::vector<SeenBall> seen = in_flight(sightings, release_t_ns, goal_line_y_m, ball.radius_m);
  if (seen.size() < kFewestOfTrack) return std::nullopt;
  const double drag_per_m = kicking::drag_per_m(ball, {});
  const auto n = static_cast<double>(seen.size());
  double mean_t_s = 0.0, spread_s2 = 0.0;
  for (const SeenBall& one : seen) mean_t_s += one.t_s / n;
  for (const SeenBall& one : seen) spread_s2 += (one.t_s - mean_t_s) * (one.t_s - mean_t_s);

  // What gravity and drag do to the path depends on the start only a little: a straight line through what they leave,
  // and again with the better start.
  const double first_s = seen.front().t_s;
  FlightState start{seen.front().ball_m, (seen.back().ball_m - seen.front().ball_m) / (seen.back().t_s - first_s)};
  for (int round = 0; round < 4; ++round) {
    FlightState now = start;
    double now_s = first_s;
    Vector3d mean_m = Vector3d::Zero(), moment = Vector3d::Zero();
    for (const SeenBall& one : seen) {
      now = flown(now, one.t_s - now_s, drag_per_m);
      now_s = one.t_s;
      const Vector3d bent_m = now.position_m - start.position_m - (one.t_s - first_s) * start.velocity_mps;
      const Vector3d straight_m = one.ball_m - bent_m;
      mean_m += straight_m / n;
      moment += (one.t_s - mean_t_s) * straight_m;
    }
    start.velocity_mps = moment / spread_s2;
    start.position_m = mean_m + (first_s - mean_t_s) * start.velocity_mps;
  }

  // Back to the floor, by Newton's steps.
  FlightState launch = start;
  for (int i = 0; i < 6; ++i) {
    const double above_m = launch.position_m.z() - ball.radius_m;
    if (!(launch.velocity_mps.z() > 0.5)) return std::nullopt;
    launch = flown(launch, -above_m / launch.velocity_mps.z(), drag_per_m);
  }
  if (std::abs(launch.position_m.z() - ball.radius_m) > 0.01) return std::nullopt;
  return LaunchTrack{launch.velocity_mps, spread_s2};
}

}  // namespace trivela::calibration
