#include "calibration/rows/recorded_drives.hpp"

#include <algorithm>
#include <limits>
#include <vector>

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

}  // namespace trivela::calibration
