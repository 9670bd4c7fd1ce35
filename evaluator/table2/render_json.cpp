#include "evaluator/render/json_values.hpp"
#include "evaluator/sessions/no_goal.hpp"
#include "evaluator/table2/table2.hpp"

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
  Json policies = Json::array();
  for (const log::HalfPolicy& half : halves)
    policies.push_back({{"half", half.half}, {"policy", half.policy}, {"robot_id", half.robot_id}});
  return policies;
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

Json loss_json(const log::Loss& loss) {
  return {{"stream", loss.stream},
          {"received", loss.received},
          {"missing", loss.missing()},
          {"lost", loss.lost},
          {"gaps", loss.gaps},
          {"overflow", loss.overflow},
          {"nan_refused", loss.nan_refused},
          {"rejected", loss.rejected},
          {"out_of_order", loss.out_of_order}};
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
          {"sound", kicker.sound()},
          {"higher_m", json_of(kicker.higher_m())},
          {"speed_ln", part(last.speed_ln)},
          {"elevation_rad", part(last.elevation_rad)},
          {"direction_rad", part(last.direction_rad)},
          {"delay_s", part(last.delay_s)},
          {"along_ratio", part(last.along)},
          {"sideways_ratio", part(last.sideways)}};
}

Json labels_json(const LabelQuality& labels, const std::vector<std::string>& goal_warnings) {
  Json rows = Json::array();
  for (const SightingsRow& row : labels.rows) {
    rows.push_back({{"sightings", row.sightings},
                    {"kicks", row.kicks},
                    {"unknown", row.unknown},
                    {"expected_wrong", labels.has_probabilities ? Json(row.expected_wrong) : Json()}});
  }
  return {{"by_sightings", rows}, {"goal_warnings", goal_warnings}};
}

Json unclosed_json(const UnclosedKick& kick) {
  return {{"session_id", kick.session_id},   {"robot_id", kick.robot_id},
          {"kick_id", kick.kick_id},         {"t_ns", kick.t_ns},
          {"policy", kick.policy},           {"has_order", kick.has_order},
          {"has_receipt", kick.has_receipt}, {"has_outcome", kick.has_outcome}};
}

Json quality_json(const Report& report) {
  Json quality = {{"data_lost", report.data_lost()},
                  {"rows_missing", report.rows_missing()},
                  {"unclosed_sessions", report.unclosed_sessions()},
                  {"warnings", report.warnings},
                  {"streams", Json::array()},
                  {"unclosed_kicks", Json::array()},
                  {"refused_orders", Json::array()},
                  {"silences", Json::array()},
                  {"unrecorded_orders", Json::array()}};
  for (const log::Loss& loss : report.losses) quality["streams"].push_back(loss_json(loss));
  for (const UnclosedKick& kick : report.unclosed_kicks) quality["unclosed_kicks"].push_back(unclosed_json(kick));
  for (const RefusedOrders& refused : report.refused_orders) {
    quality["refused_orders"].push_back({{"policy", refused.policy},
                                         {"refusal", refused.refusal},
                                         {"orders", refused.orders},
                                         {"not_fired", refused.not_fired}});
  }
  quality["not_counted"] = report.not_counted;
  quality["lengths"] = Json::array();
  for (const PlayedLength& length : report.lengths) {
    quality["lengths"].push_back({{"session_id", length.session_id},
                                  {"planned_s", length.planned_s},
                                  {"recorded_s", length.recorded_s},
                                  {"cut_short", length.cut_short()}});
  }
  for (const RecordedSilence& silence : report.silences) quality["silences"].push_back(silence_json(silence));
  for (const UnrecordedOrders& orders : report.unrecorded_orders) {
    quality["unrecorded_orders"].push_back(unrecorded_json(orders));
  }
  quality["labels"] = labels_json(report.labels, report.goal_warnings);
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
  Json json = {{"simulated", report.simulated_sessions() > 0}, {"logs", report.logs}, {"policies", Json::array()}};
  for (const PolicyRow& row : report.policies) json["policies"].push_back(policy_json(row));
  json["robots"] = Json::array();
  for (const RobotRow& row : report.robots) {
    json["robots"].push_back(policy_json(row));
    json["robots"].back()["robot_id"] = row.robot_id;
  }
  json["sessions"] = Json::array();
  for (const auto& session : report.sessions) {
    if (!session.arm) json["sessions"].push_back(session_json(session, report.imports));
  }
  json["arms"] = Json::array();
  for (const Arm& arm : report.arms) json["arms"].push_back(arm_json(arm));
  json["said"] = Json::array();
  for (const SessionNote& note : report.notes)
    json["said"].push_back({{"kind", note.kind}, {"text", *note.text}, {"who", note.who}, {"utc_ns", note.utc_ns}});
  json["kickers"] = Json::array();
  for (const LearnedKicker& kicker : report.kickers) json["kickers"].push_back(kicker_json(kicker));
  json["data_quality"] = quality_json(report);
  if (!report.gates.empty()) json["gates"] = gates_json(report.gates);
  json["notes"] = {"inside: between the posts and below the bar, saves included; it is not goals scored",
                   "efficiency: inside over the kicks whose outcome is known; efficiency_bounds: if every unknown "
                   "kick was outside and as many labels as may be are wrong (Poisson's 97.5 % of expected_wrong), and "
                   "the reverse"};
  return json_text(json);
}

}  // namespace trivela::evaluator
