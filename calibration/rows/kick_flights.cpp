#include "calibration/rows/kick_flights.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "calibration/rows/kick_flights.sql.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "kicking/geometry/time.hpp"
#include "log/read/reader.hpp"

namespace trivela::calibration {
namespace {

/// A kick with its session's place.
struct FlightRow {
  std::uint32_t session = 0;
  bool seen = false;
  LoggedFlight logged;
};

FlightRow flight_row(const log::NamedCells& row, std::uint32_t session, double delay_s) {
  const auto t_ns = row.get<std::int64_t>("t_ns");
  const double delay_of_log_s =
      kicking::seconds(row.get<std::int64_t>("release_t_ns") - row.get<std::int64_t>("fired_t_ns"));
  const double lead_s = kicking::seconds(row.get<std::int64_t>("fired_t_ns") - t_ns) + delay_s;
  FlightRow result{.session = session, .seen = row.find<double>("flight_speed_mps").has_value(), .logged = {}};
  result.logged.utc_ns = row.get<std::int64_t>("utc_ns");
  result.logged.kick_id = row.get<std::int64_t>("kick_id");
  kicking::KickFlight& flight = result.logged.flight;
  flight.power = row.get<double>("power");
  flight.twist = {row.get<double>("vx_mps"), row.get<double>("vy_mps"), row.get<double>("omega_radps")};
  flight.release = kicking::advance({row.get<double>("x_m"), row.get<double>("y_m"), row.get<double>("heading_rad")},
                                    flight.twist, lead_s);
  if (!result.seen) return result;
  flight.speed_mps = row.get<double>("flight_speed_mps");
  flight.elevation_rad = row.get<double>("flight_elevation_rad");
  flight.direction_rad = row.get<double>("flight_direction_rad");
  flight.sd_mps = row.get<double>("flight_sd_mps");
  if (const auto late_s = row.find<double>("release_late_s")) flight.late_s = *late_s + delay_of_log_s - delay_s;
  return result;
}

}  // namespace

LoggedFlights flights_in(const std::vector<std::filesystem::path>& logs, int robot_id, double delay_s) {
  LoggedFlights result;
  evaluator::SessionIndex index;
  std::vector<FlightRow> rows;
  std::set<int> robots;
  for (const std::filesystem::path& path : logs) {
    const log::Reader reader(path);
    const evaluator::SessionPlaces fresh = index.add(reader, path.filename().string());
    reader.query(kKickFlightsSql, [&](const log::NamedCells& row) {
      const auto session = fresh.find(row.get<std::int64_t>("session_id"));
      if (session == fresh.end()) return;
      robots.insert(row.get<int>("robot_id"));
      if (row.get<int>("robot_id") != robot_id) return;
      result.simulated = result.simulated || row.get<bool>("simulated");
      rows.push_back(flight_row(row, session->second, delay_s));
    });
  }
  index.settle();
  result.robots.assign(robots.begin(), robots.end());
  result.remarks = index.remarks();
  result.remarks.insert(result.remarks.end(), index.not_counted().begin(), index.not_counted().end());
  for (FlightRow& row : rows) {
    if (!index.counts(row.session, robot_id, row.logged.kick_id)) continue;
    ++result.kicks;
    row.logged.match = index.sessions()[row.session].match;
    if (row.seen) result.flights.push_back(row.logged);
  }
  std::ranges::stable_sort(result.flights, {},
                           [](const LoggedFlight& flight) { return std::pair(flight.utc_ns, flight.kick_id); });
  return result;
}

}  // namespace trivela::calibration
