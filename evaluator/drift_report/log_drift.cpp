#include "evaluator/drift_report/log_drift.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <utility>

#include "evaluator/render/json_values.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/policy/policy.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {
namespace {

constexpr const char* kWatchedKicksSql = R"(
SELECT k.session_id, s.uuid, s.simulated, k.robot_id, k.kick_id, k.t_ns, k.t_ns + u.utc_offset_ns AS utc_ns, k.release_t_ns,
  k.outcome, k.bounced, k.policy, k.z_cross_m, k.exit_speed_mps, d.x_m, d.y_m, d.heading_rad, d.vx_mps, d.vy_mps, d.omega_radps,
  d.target_y_m, d.kick_kind, d.predicted_x_cross_m, d.predicted_z_cross_m, d.predicted_t_flight_s
FROM counted_kicks AS k
CROSS JOIN kick_decisions AS d ON d.session_id = k.session_id AND d.robot_id = k.robot_id AND d.seq = k.seq  -- this order
JOIN sessions AS s ON s.session_id = k.session_id
JOIN utc_offsets AS u ON u.session_id = k.session_id
WHERE k.accepted = 1)";

/// A kick with where it stands.
struct Row {
  std::uint32_t session = 0;
  int robot_id = 0;
  bool simulated = false;
  DriftKick at;
  WatchedKick kick;
};

std::vector<Row> watched_rows(const log::Reader& reader, std::size_t log, const SessionPlaces& fresh) {
  std::vector<Row> rows;
  reader.query(kWatchedKicksSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto kick_id = row.get<std::int64_t>("kick_id");
    const auto t_ns = row.get<std::int64_t>("t_ns");
    const auto release_t_ns = row.find<std::int64_t>("release_t_ns");
    const auto outcome = row.find<std::string>("outcome");
    const auto predicted_x_m = row.find<double>("predicted_x_cross_m");
    const auto predicted_z_m = row.find<double>("predicted_z_cross_m");
    const auto t_flight_s = row.find<double>("predicted_t_flight_s");
    const auto session = fresh.find(session_id);
    if (session == fresh.end()) return;
    Row& watched =
        rows.emplace_back(Row{session->second,
                              row.get<int>("robot_id"),
                              row.get<bool>("simulated"),
                              {log, session_id, row.get<std::string>("uuid"), kick_id, row.get<std::int64_t>("utc_ns")},
                              {}});
    watched.kick = {.kick_id = kick_id,
                    .t_ns = t_ns,
                    .robot = {row.get<double>("x_m"), row.get<double>("y_m"), row.get<double>("heading_rad")},
                    .twist = {row.get<double>("vx_mps"), row.get<double>("vy_mps"), row.get<double>("omega_radps")},
                    .policy = kicking::row_of(row.get<std::string>("policy")).value_or(-1),
                    .goal_y_m = row.get<double>("target_y_m")};
    if (!predicted_x_m || !predicted_z_m || !t_flight_s || row.get<int>("kick_kind") != 0) return;
    watched.kick.x_m = *predicted_x_m;
    watched.kick.z_m = *predicted_z_m;
    watched.kick.t_flight_s = *t_flight_s;
    watched.kick.lead_s = release_t_ns ? kicking::seconds(*release_t_ns - t_ns) : 0.0;
    watched.kick.seen_to_the_line = outcome && *outcome != "blocked" && *outcome != "unknown";
    watched.kick.bounced = row.find<bool>("bounced").value_or(false);
    watched.kick.z_cross_m = row.find<double>("z_cross_m");
    watched.kick.exit_speed_mps = row.find<double>("exit_speed_mps");
  });
  return rows;
}

/// The kicks of all logs, each once, and what became of their kickers.
class DriftKicks {
 public:
  void add(const log::Reader& reader, const std::string& name) {
    for (Row& row : watched_rows(reader, logs_++, index_.add(reader, name))) rows_.push_back(std::move(row));
  }

  DriftReport tell() {
    index_.settle();
    DriftReport report{.robots = {}, .remarks = index_.remarks()};
    report.remarks.insert(report.remarks.end(), index_.not_counted().begin(), index_.not_counted().end());
    std::erase_if(rows_, [&](const Row& row) { return !index_.counts(row.session, row.robot_id, row.at.kick_id); });
    std::ranges::stable_sort(rows_, {}, [](const Row& row) { return std::pair(row.at.utc_ns, row.at.kick_id); });
    using Series = std::pair<int, std::string>;  // robot; session where it is one by itself
    std::map<Series, std::vector<const Row*>> series;
    for (const Row& row : rows_) series[{row.robot_id, row.simulated ? row.at.session : ""}].push_back(&row);
    for (const auto& [of, kicks] : series) report.robots.push_back(timeline_of(of.first, kicks));
    std::ranges::stable_sort(report.robots, {}, [](const RobotDrift& robot) {
      return std::pair(robot.robot_id, robot.kicks.front().utc_ns);
    });
    return report;
  }

 private:
  static RobotDrift timeline_of(int robot_id, const std::vector<const Row*>& kicks) {
    RobotDrift robot;
    robot.robot_id = robot_id;
    robot.simulated = kicks.front()->simulated;
    std::vector<KickResidual> residuals;
    for (const Row* const row : kicks) {
      if (robot.kicks.empty() || robot.kicks.back().session != row->at.session) ++robot.sessions;
      robot.kicks.push_back(row->at);
      residuals.push_back(residual_of(row->kick));
    }
    robot.timeline = drifts_of(residuals);
    return robot;
  }

  std::size_t logs_ = 0;
  std::vector<Row> rows_;
  SessionIndex index_;
};

constexpr std::size_t kMostQuiet = 20;  // series without a change that are named one by one

std::string utc(std::int64_t utc_ns) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(static_cast<std::time_t>(utc_ns / 1'000'000'000)));
}

std::string head_of(const RobotDrift& robot) {
  return fmt::format("robot {}: {} kicks in {} session{}{}", robot.robot_id, robot.kicks.size(), robot.sessions,
                     robot.sessions == 1 ? "" : "s",
                     robot.simulated ? fmt::format(" {}", robot.kicks.front().session) : "");
}

std::string told(const RobotDrift& robot) {
  std::string text = head_of(robot) + "\n";
  for (const Drift& drift : robot.timeline.drifts) {
    const DriftKick& kick = robot.kicks[drift.changed];
    text += fmt::format("  from kick {} on ({}, kick_id {}): {}; certain with kick {}\n", drift.changed + 1,
                        utc(kick.utc_ns), kick.kick_id, words_of(drift), drift.found + 1);
    text += fmt::format("    {}\n", correction_of(drift));
  }
  text += fmt::format("  {}: {}\n", robot.timeline.drifts.empty() ? "no change" : "since then",
                      level_words(robot.timeline.level));
  return text;
}

Json shift_json(const Shift& shift) { return {{"value", shift.value}, {"standard_error", shift.se}}; }

Json drift_json(const RobotDrift& robot, const Drift& drift) {
  const DriftKick& kick = robot.kicks[drift.changed];
  return {{"kind", drift.kind == DriftKind::kElevation ? "elevation" : "exit_speed"},
          {"kick", drift.changed + 1},
          {"kick_id", std::to_string(kick.kick_id)},
          {"session", kick.session},
          {"utc_ns", kick.utc_ns},
          {"found_with_kick", drift.found + 1},
          {"ln_speed", shift_json(drift.factor)},
          {"ln_speed_of_exit_speeds", drift.speed ? shift_json(*drift.speed) : Json()},
          {"height_m", drift.height_m},
          {"multiply_speeds_by", drift.kind == DriftKind::kElevation ? Json() : Json(std::exp(drift.factor.value))},
          {"correction", correction_of(drift)}};
}

}  // namespace

bool DriftReport::found() const {
  return std::ranges::any_of(robots, [](const RobotDrift& robot) { return !robot.timeline.drifts.empty(); });
}

DriftReport drift_in(const std::vector<std::filesystem::path>& logs) {
  DriftKicks index;
  for (const std::filesystem::path& path : logs) index.add(log::Reader{path}, path.string());
  return index.tell();
}

DriftReport drift_in(std::span<const OpenLog> logs) {
  DriftKicks index;
  for (const OpenLog& log : logs) index.add(*log.reader, log.name);
  return index.tell();
}

std::string level_words(const DriftLevel& level) {
  if (level.heights < 2) return "too few heights to tell its level";
  return fmt::format("{} its table by {:.1f} % of speed (standard error {:.1f}, {} heights)",
                     level.height.value < 0.0 ? "below" : "above", 100.0 * std::abs(std::expm1(level.height.value)),
                     100.0 * level.height.se, level.heights);
}

std::string to_text(const DriftReport& report) {
  std::string text;
  std::size_t quiet = 0;
  bool simulated = false;
  for (const RobotDrift& robot : report.robots) {
    simulated = simulated || robot.simulated;
    if (!robot.timeline.drifts.empty() || ++quiet <= kMostQuiet) text += told(robot);
  }
  if (quiet > kMostQuiet) text += fmt::format("and {} more without a change\n", quiet - kMostQuiet);
  if (report.robots.empty()) text = "no kick that was accepted\n";
  return (simulated ? kSimulated : "") + text;
}

std::string to_json(const DriftReport& report) {
  const auto robot_json = [](const RobotDrift& robot) {
    const DriftLevel& now = robot.timeline.level;
    return Json{
        {"robot", robot.robot_id},
        {"simulated", robot.simulated},
        {"kicks", robot.kicks.size()},
        {"sessions", robot.sessions},
        {"drifts", json_list(robot.timeline.drifts, [&](const Drift& drift) { return drift_json(robot, drift); })},
        {"level",
         {{"from_kick", now.from + 1},
          {"heights", now.heights},
          {"ln_speed_by_heights", shift_json(now.height)},
          {"exit_speeds", now.speeds},
          {"ln_speed_by_exit_speeds", shift_json(now.speed)}}}};
  };
  return json_text(Json{{"robots", json_list(report.robots, robot_json)}, {"remarks", report.remarks}});
}

}  // namespace trivela::evaluator
