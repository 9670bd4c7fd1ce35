#include <algorithm>

#include "evaluator/render/json_values.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/table2/report_parts.hpp"

namespace trivela::evaluator {
namespace {

Json policy_json(const PolicyRow& row) {
  Json misses = Json::object();
  for (const std::string& miss : kMisses) misses[miss] = row.of(miss);
  if (row.of("outside") > 0) misses["outside"] = row.of("outside");
  for (const NoGoal& rule : kNoGoals)
    if (row.of(rule.label) > 0) misses[rule.label] = row.of(rule.label);
  return {{"arm", row.arm.empty() ? Json() : Json(row.arm)},
          {"policy", row.policy},
          {"inside", row.inside()},
          {"outside", row.outside()},
          {"unknown", row.unknown()},
          {"efficiency", json_of(stats::efficiency(row.counts()))},
          {"wilson95", json_of(row.efficiency_ci())},
          {"repeated_in_paired_halves", row.repeated},
          {"efficiency_bounds", json_of(row.efficiency_bounds())},
          {"expected_wrong", {{"inside", row.doubt.inside}, {"outside", row.doubt.outside}}},
          {"played_min", json_of(row.played_min)},
          {"kicks_per_min", json_of(row.kicks_per_min())},
          {"bounced", said_json(row.inside_kicks.bounced, "bounced")},
          {"saved", said_json(row.inside_kicks.saved, "saved")},
          {"goals", row.goals()},
          {"goal_not_known", row.goal_not_known()},
          {"blocked", row.blocked_apart ? "apart" : "outside"},
          {"misses", misses}};
}

Json policies_json(const std::vector<log::HalfPolicy>& halves) {
  return json_list(halves, [](const log::HalfPolicy& half) {
    return Json{{"half", half.half}, {"policy", half.policy}, {"robot_id", half.robot_id}};
  });
}

Json session_json(const log::RecordedSession& session, const ImportNotes& imports) {
  const auto notes = imports.find(session.session_id);
  return {{"uuid", session.uuid},
          {"robot_id", json_of(session.robot_id)},
          {"simulated", session.simulated},
          {"scenario", session.scenario},
          {"imported", notes == imports.end() ? Json() : Json(notes->second)},
          {"seed", json_of(session.seed)},
          {"software_version", session.software_version},
          {"config_sha256", session.config_sha256},
          {"closed", session.closed_t_ns.has_value()},
          {"continues", session.continues_uuid.empty() ? Json() : Json(session.continues_uuid)},
          {"replays", session.replays_uuid.empty() ? Json() : Json(session.replays_uuid)},
          {"paired_halves", session.paired_halves},
          {"planned_s", json_of(session.planned_s)},
          {"policies", policies_json(session.policies)}};
}

Json arm_json(const Arm& arm) {
  return {{"arm", arm.name},
          {"log", arm.log},
          {"scenario", arm.scenario},
          {"table", arm.table.empty() ? Json() : Json(arm.table)},
          {"software_version", arm.software_version},
          {"configurations", arm.configurations},
          {"sessions", arm.sessions},
          {"matches", arm.matches},
          {"policies", policies_json(arm.policies)}};
}

Json silence_json(const RecordedSilence& silence) {
  return {{"session_id", silence.session_id},    {"stream", silence.stream},
          {"robot_id", silence.robot_id},        {"from_t_ns", silence.from_t_ns},
          {"to_t_ns", json_of(silence.to_t_ns)}, {"from_s", silence.from_s()},
          {"to_s", json_of(silence.to_s())},     {"counts", silence.counts}};
}

Json unrecorded_json(const UnrecordedOrders& orders) {
  return {{"session_id", orders.session_id},
          {"robot_id", orders.robot_id},
          {"continues", orders.continues},
          {"restarted_before", orders.restarted_before},
          {"orders_before", orders.orders_before},
          {"kicks_before", orders.kicks_before},
          {"orders_within", orders.orders_within},
          {"kicks_within", orders.kicks_within},
          {"counts", orders.counts()}};
}

Json kicker_json(const LearnedKicker& kicker) {
  const auto part = [](const LearnedPart& of) { return Json{{"value", of.value}, {"se", of.se}}; };
  const KickerStep& last = kicker.steps.back();
  return {{"session_id", kicker.session_id},
          {"robot_id", kicker.robot_id},
          {"used", kicker.used},
          {"kicks", kicker.kicks()},
          {"mistaken", kicker.mistaken()},
          {"mean_chi_square", kicker.mean_chi_square()},
          {"sound", kicker.valid()},
          {"higher_m", json_of(kicker.higher_m())},
          {"speed_ln", part(last.speed_ln)},
          {"elevation_rad", part(last.elevation_rad)},
          {"direction_rad", part(last.direction_rad)},
          {"delay_s", part(last.delay_s)},
          {"along_ratio", part(last.along)},
          {"sideways_ratio", part(last.sideways)}};
}

Json unclosed_json(const UnclosedKick& kick) {
  return {{"session_id", kick.session_id},   {"robot_id", kick.robot_id},
          {"kick_id", kick.kick_id},         {"t_ns", kick.t_ns},
          {"policy", kick.policy},           {"has_order", kick.has_order},
          {"has_receipt", kick.has_receipt}, {"has_outcome", kick.has_outcome}};
}

Json refused_json(const RefusedOrders& refused) {
  return {{"policy", refused.policy},
          {"refusal", refused.refusal},
          {"orders", refused.orders},
          {"not_fired", refused.not_fired}};
}

Json quality_json(const Report& report) {
  Json quality = {
      {"data_lost", report.data_lost()},
      {"rows_missing", report.rows_missing()},
      {"unclosed_sessions", report.unclosed_sessions()},
      {"warnings", report.warnings},
      {"streams", rows_json(loss_table(report.losses))},
      {"unclosed_kicks", json_list(report.unclosed_kicks, unclosed_json)},
      {"refused_orders", json_list(report.refused_orders, refused_json)},
      {"silences", json_list(report.silences, silence_json)},
      {"unrecorded_orders", json_list(report.unrecorded_orders, unrecorded_json)},
      {"not_counted", report.not_counted},
      {"lengths", rows_json(length_table(report.lengths))},
      {"labels",
       {{"by_sightings", rows_json(sightings_table(report.labels))}, {"goal_warnings", report.goal_warnings}}}};
  quality["hand_labels"] = {{"kicks", report.hand_labels.kicks},
                            {"compared", report.hand_labels.compared},
                            {"disagreed", report.hand_labels.disagreed},
                            {"observer_knew_not", report.hand_labels.observer_knew_not}};
  quality["verification"] = {{"verified_rows", report.verified_rows},
                             {"doubt", report.doubt ? Json(*report.doubt) : Json()}};
  if (report.compared_with_truth > 0) {
    quality["truth"] = {{"compared", report.compared_with_truth}, {"alike", report.alike_with_truth}};
  }
  return quality;
}

}  // namespace

std::string to_json(const Report& report) {
  std::vector<log::RecordedSession> sessions;
  std::ranges::copy_if(report.sessions, std::back_inserter(sessions), [](const auto& of) { return !of.arm; });
  const auto robot_json = [](const RobotRow& row) {
    Json json = policy_json(row);
    json["robot_id"] = row.robot_id;
    return json;
  };
  const auto note_json = [](const SessionNote& note) {
    Json json{{"kind", note.kind}, {"text", *note.text}, {"who", note.who}, {"utc_ns", note.utc_ns}};
    if (!note.uuid.empty()) json["session"] = note.uuid;
    return json;
  };
  Json json = {{"simulated", report.simulated_sessions() > 0},
               {"logs", report.logs},
               {"policies", json_list(report.policies, policy_json)},
               {"robots", json_list(report.robots, robot_json)},
               {"sessions", json_list(sessions, [&](const auto& of) { return session_json(of, report.imports); })},
               {"arms", json_list(report.arms, arm_json)},
               {"said", json_list(report.notes, note_json)},
               {"kickers", json_list(report.kickers, kicker_json)}};
  json["data_quality"] = quality_json(report);
  if (!report.gates.empty()) json["gates"] = gates_json(report.gates);
  json["notes"] = {"inside: between the posts and below the bar, saves included; it is not goals scored",
                   "efficiency: inside over the kicks whose outcome is known; efficiency_bounds: if every unknown "
                   "kick was outside and as many labels as may be are wrong (Poisson's 97.5 % of expected_wrong), and "
                   "the reverse"};
  return json_text(json);
}

}  // namespace trivela::evaluator
