#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "evaluator/drift_report/log_drift.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/simulated.hpp"

namespace trivela::evaluator {
namespace {

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
  for (const Drift& drift : robot.story.drifts) {
    const DriftKick& kick = robot.kicks[drift.changed];
    text += fmt::format("  from kick {} on ({}, kick_id {}): {}; certain with kick {}\n", drift.changed + 1,
                        utc(kick.utc_ns), kick.kick_id, words_of(drift), drift.found + 1);
    text += fmt::format("    {}\n", correction_of(drift));
  }
  text += fmt::format("  {}: {}\n", robot.story.drifts.empty() ? "no change" : "since then",
                      level_words(robot.story.level));
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
    if (!robot.story.drifts.empty() || ++quiet <= kMostQuiet) text += told(robot);
  }
  if (quiet > kMostQuiet) text += fmt::format("and {} more without a change\n", quiet - kMostQuiet);
  if (report.robots.empty()) text = "no kick that was accepted\n";
  return (simulated ? kSimulated : "") + text;
}

std::string to_json(const DriftReport& report) {
  Json robots = Json::array();
  for (const RobotDrift& robot : report.robots) {
    Json drifts = Json::array();
    for (const Drift& drift : robot.story.drifts) drifts.push_back(drift_json(robot, drift));
    const DriftLevel& now = robot.story.level;
    robots.push_back({{"robot", robot.robot_id},
                      {"simulated", robot.simulated},
                      {"kicks", robot.kicks.size()},
                      {"sessions", robot.sessions},
                      {"drifts", drifts},
                      {"level",
                       {{"from_kick", now.from + 1},
                        {"heights", now.heights},
                        {"ln_speed_by_heights", shift_json(now.height)},
                        {"exit_speeds", now.speeds},
                        {"ln_speed_by_exit_speeds", shift_json(now.speed)}}}});
  }
  return json_text(Json{{"robots", robots}, {"remarks", report.remarks}});
}

}  // namespace trivela::evaluator
