#include "pages/monitor/match_scene.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "evaluator/timeline/decided_segments.hpp"
#include "kicking/geometry/angle.hpp"
#include "pages/monitor/match_feed.hpp"
#include "pages/monitor/monitor.css.hpp"
#include "pages/monitor/monitor.html.hpp"
#include "pages/monitor/monitor.js.hpp"
#include "pages/monitor/pitch.js.hpp"

namespace trivela::pages {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kShownKicks = 12;
constexpr std::int64_t kFlightAge_ns = 200'000'000;

std::int64_t ms_of(std::int64_t ns) { return ns / 1'000'000; }

/// To a thousandth, null where it is not finite.
Json number(double value) { return std::isfinite(value) ? Json(std::round(1000.0 * value) / 1000.0) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
Json point(const Eigen::Vector2d& at) { return Json::array({number(at.x()), number(at.y())}); }

std::string dumped(const Json& document) { return document.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json segments_json(const msg::KickDecision& d) {
  const auto segments = evaluator::decided_segments({{d.x_m, d.y_m, d.heading_rad},
                                                     d.alpha_rad,
                                                     {d.target_x_m, d.target_y_m},
                                                     d.distance_m,
                                                     d.aligned,
                                                     d.offset_right_m,
                                                     d.left_m,
                                                     d.right_m});
  return {{"s1", {point(segments.s1_from_m), point(segments.s1_to_m)}},
          {"s2", {point(segments.s2_left_m), point(segments.s2_right_m)}},
          {"meet", segments.aligned}};
}

Json kicker_json(const msg::KickerStatus* kicker) {
  if (kicker == nullptr) return nullptr;
  return {{"state", msg::label(kicker->state)},
          {"charge", number(kicker->charge)},
          {"modelled", kicker->charge_modelled},
          {"ready", kicker->ready}};
}

/// What its kicks say of its kicker: exit speed in per cent of its file, angle in degrees.
Json estimate_json(const std::optional<msg::KickerEstimate>& estimate) {
  if (!estimate || estimate->kicks == 0) return nullptr;
  return {{"kicks", estimate->kicks},
          {"used", estimate->used},
          {"speed_percent", number(100.0 * std::expm1(estimate->speed_ln))},
          {"speed_se_percent", number(100.0 * estimate->speed_ln_se)},
          {"angle_deg", number(kicking::degrees(estimate->elevation_rad))},
          {"angle_se_deg", number(kicking::degrees(estimate->elevation_se_rad))}};
}

/// The decision that is shown.
const msg::KickDecision* shown_decision(const RobotView& robot, std::int64_t now_ns) {
  const auto* fired = recent_fire(robot, now_ns);
  return fired != nullptr ? fired : robot.decision.within(kFresh_ns, now_ns);
}

Json robot_json(std::uint8_t id, const RobotView& robot, std::int64_t now_ns) {
  const Why why = why_of(robot, now_ns);
  Json shown{{"id", id}, {"fires", why.fires}, {"why", why.words}};
  const auto* world = robot.world.within(kFresh_ns, now_ns);
  shown["fresh"] = world != nullptr;
  if (const auto& last = robot.world.sample) {
    shown["x"] = number(last->x_m);
    shown["y"] = number(last->y_m);
    shown["heading"] = number(last->heading_rad);
    shown["has_ball"] = world != nullptr && last->possession;
    if (world != nullptr) {
      Json others = Json::array();
      for (std::size_t i = 0; i < std::min<std::size_t>(last->opponent_count, std::size(last->opponent_x_m)); ++i)
        others.push_back({number(last->opponent_x_m[i]), number(last->opponent_y_m[i])});
      shown["opponents"] = others;
      shown["keeper"] = number(last->keeper_x_m);
    }
    if (world != nullptr && last->ball_known) shown["ball"] = {number(last->ball_x_m), number(last->ball_y_m)};
  }
  shown["kicker"] = kicker_json(robot.kicker.within(kFresh_ns, now_ns));
  shown["learned"] = estimate_json(robot.estimate.sample);
  if (const auto* decision = shown_decision(robot, now_ns)) {
    shown["policy"] = msg::policy_name(*decision);
    shown["distance"] = number(decision->distance_m);
    shown["power"] = number(decision->power);
    shown["p"] = number(decision->p_on_target);
    if (decision->distance_m > 0.0) shown["segments"] = segments_json(*decision);  // 0: nothing was aimed at
  }
  return shown;
}

/// The ball of the newest kick while it is under way: at any other time a goal camera sees one that nobody kicked.
Json flight_json(const SceneState& state, std::int64_t now_ns) {
  for (const KnownKick& kick : state.kicks.latest(1)) {
    const auto robot = state.robots.find(kick.robot_id);
    if (robot == state.robots.end() || fate_of(kick, ledger_now(state, now_ns)) != KickFate::kUnderWay) continue;
    const auto* frame = robot->second.flight.within(kFlightAge_ns, now_ns);
    if (frame != nullptr && frame->ball_seen)
      return Json::array({number(frame->ball_x_m), number(frame->ball_y_m), number(frame->ball_z_m)});
  }
  return nullptr;
}

const char* name_of(KickFate fate) {
  constexpr std::array kNames{"under way", "refused", "inside", "outside", "unknown"};
  return kNames.at(static_cast<std::size_t>(fate));
}

Json kick_json(const KnownKick& kick, const LedgerNow& now) {
  const KickFate fate = fate_of(kick, now);
  Json shown{{"id", std::to_string(kick.kick_id)}, {"robot", kick.robot_id}, {"fate", name_of(fate)}};
  shown["policy"] = kick.decided ? Json(kick.decided->policy.name()) : Json(nullptr);
  if (kick.decided) {
    shown["distance"] = number(kick.decided->distance_m);
    shown["power"] = number(kick.decided->power);
    shown["p"] = number(kick.decided->p_on_target);
    if (kick.decided->kick_kind > 0) shown["kind"] = kick.decided->kick_kind + 1;
  }
  if (fate == KickFate::kRefused) shown["refusal"] = msg::label(kick.answered->refusal);
  if (kick.ended) {
    const auto& saved = kick.ended->saved;
    shown["outcome"] = !saved ? msg::label(kick.ended->outcome) : *saved ? "saved" : "goal";
    shown["x"] = number(kick.ended->x_m);
    shown["z"] = number(kick.ended->z_m);
  }
  return shown;
}

Json interval_json(const evaluator::stats::Interval& interval) {
  return Json::array({number(interval.lo), number(interval.hi)});
}

Json table_json(const RunningTable& table) {
  Json rows = Json::array();
  for (const RunningRow& row : table.rows) {
    rows.push_back({{"policy", row.policy},
                    {"inside", row.kicks.inside},
                    {"goals", row.kicks.goals},
                    {"outside", row.kicks.outside},
                    {"unknown", row.kicks.unknown},
                    {"under_way", row.kicks.under_way},
                    {"refused", row.kicks.refused},
                    {"efficiency", number(evaluator::stats::efficiency(row.counts()))},
                    {"interval", interval_json(row.interval)}});
  }
  Json shown{{"rows", rows}, {"difference", nullptr}};
  if (table.difference) {
    shown["difference"] = {{"older", table.difference->older},
                           {"newer", table.difference->newer},
                           {"value", number(table.difference->value)},
                           {"interval", interval_json(table.difference->interval)}};
  }
  return shown;
}

Json referee_json(const SceneState& state) {
  const auto& word = state.referee.sample;
  if (!word) return nullptr;
  Json shown{{"half", word->half},     {"stage", msg::label(word->stage)}, {"playing", word->playing},
             {"own", word->goals_own}, {"other", word->goals_other},       {"restart", msg::label(word->restart)},
             {"ours", word->ours}};
  shown["clock_s"] = std::isfinite(word->half_time_s) ? Json(std::floor(word->half_time_s)) : Json(nullptr);
  return shown;
}

Json alarms_json(const SceneState& state) {
  Json alarms = Json::array();
  for (const auto& [name, alarm] : state.alarms.alarms())
    alarms.push_back({{"name", name}, {"text", alarm.text}, {"since_ms", ms_of(alarm.since_ns)}});
  return alarms;
}

Json mended_json(const SceneState& state) {
  Json mended = Json::array();
  for (const MendedAlarm& alarm : state.alarms.mended())
    mended.push_back({{"text", alarm.text}, {"from_ms", ms_of(alarm.from_ns)}, {"to_ms", ms_of(alarm.to_ns)}});
  return mended;
}

std::int64_t missed(const SceneState& state) {
  std::int64_t messages = 0;
  for (const auto& [topic, stream] : state.streams) {
    for (const auto& [id, received] : stream.robots) messages += received.lost();
  }
  return messages;
}

Json field_json(const SceneSettings& settings) {
  return {{"goal_y", number(settings.goal.y_m)},
          {"goal_half_width", number(settings.goal.half_width_m)},
          {"post", number(settings.goal.post_width_m)},
          {"side_line_x", number(settings.side_line_x_m)}};
}

}  // namespace

std::string pitch_json(const SceneState& state, std::int64_t now_ns) {
  Json robots = Json::array();
  for (const auto& [id, robot] : state.robots) robots.push_back(robot_json(id, robot, now_ns));
  return dumped({{"now_ms", ms_of(now_ns)}, {"robots", robots}, {"flight", flight_json(state, now_ns)}});
}

std::string match_json(const SceneState& state, std::int64_t now_ns) {
  const LedgerNow now = ledger_now(state, now_ns);
  Json kicks = Json::array();
  for (const KnownKick& kick : state.kicks.latest(kShownKicks)) kicks.push_back(kick_json(kick, now));
  Json names = Json::object();
  for (const auto& [id, name] : state.settings.names) names[std::to_string(id)] = name;
  return dumped({{"title", state.settings.title},
                 {"names", names},
                 {"simulated", state.simulated},
                 {"over", state.over},
                 {"field", field_json(state.settings)},
                 {"referee", referee_json(state)},
                 {"kicks", kicks},
                 {"table", table_json(running_table(state.kicks.tallies(now)))},
                 {"alarms", alarms_json(state)},
                 {"mended", mended_json(state)},
                 {"missed", missed(state)},
                 {"nodes", state.nodes}});
}

Page monitor_page(std::string token) {
  Page page;
  page.assets = {{"/", kMonitorHtml, "text/html; charset=utf-8"},
                 {"/monitor.js", kMonitorJs, "text/javascript; charset=utf-8"},
                 {"/pitch.js", kPitchJs, "text/javascript; charset=utf-8"},
                 {"/monitor.css", kMonitorCss, "text/css; charset=utf-8"}};
  page.token = std::move(token);
  page.most_viewers = 48;
  return page;
}

}  // namespace trivela::pages
