#include "calibration/rows/recorded_drives.hpp"

#include <limits>

#include "calibration/rows/ball_sightings.sql.hpp"
#include "calibration/rows/drive_kicks.sql.hpp"
#include "evaluator/report/log_sessions.hpp"

namespace trivela::calibration {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

RecordedDrives recorded_drives(const evaluator::log::Reader& reader) {
  RecordedDrives result;
  evaluator::SessionBook book;
  const evaluator::SessionPlaces places = book.add(reader, "");
  book.settle();
  reader.query(
      kDriveKicksSql,
      [&](const std::string& policy, std::int64_t order_t_ns, double x_m, double y_m, double heading_rad, double vx_mps,
          double vy_mps, double omega_radps, double goal_line_y_m, double power, std::optional<double> x_cross_m,
          std::optional<double> z_cross_m, std::int64_t session_id, int robot_id, std::int64_t kick_id) {
        if (!book.counts(places.at(session_id), robot_id, kick_id)) return;
        result.kicks.push_back({.policy = policy,
                                .order_t_ns = order_t_ns,
                                .pose = {x_m, y_m, heading_rad},
                                .twist = {vx_mps, vy_mps, omega_radps},
                                .goal_line_y_m = goal_line_y_m,
                                .power = power,
                                .x_cross_m = x_cross_m,
                                .z_cross_m = z_cross_m,
                                .robot = {session_id, robot_id}});
      });
  reader.query(kBallSightingsSql, [&](std::int64_t session_id, std::int64_t robot_id, std::int64_t t_exposure_ns,
                                      std::optional<double> x_m, std::optional<double> y_m, std::optional<double> z_m) {
    result.sightings[{session_id, robot_id}].push_back(
        {t_exposure_ns, {x_m.value_or(kNaN), y_m.value_or(kNaN), z_m.value_or(kNaN)}});
  });
  return result;
}

}  // namespace trivela::calibration
