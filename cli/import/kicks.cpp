#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cli/import/kick_labels.hpp"
#include "cli/import/row_writing.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "idl/messages.hpp"
#include "kicking/kick_id.hpp"
#include "kicking/text/printable.hpp"
#include "log/schema/digest.hpp"

namespace trivela::cli {
namespace {

struct KicksArguments {
  std::string csv;
  std::string out;
};

/// What the match log and its reports say of where it is from.
std::vector<std::string> sentences_of(const KickLabels& labels) {
  std::vector<std::string> sentences{
      fmt::format("outcomes labelled by hand, by {}: {} kicks of {}", fmt::join(labels.labellers(), ", "),
                  labels.kicks.size(), labels.file),
      fmt::format("{} of them with a time; where they were kicked from and how is not known: such numbers stand as 0",
                  labels.timed())};
  for (std::string& sentence : sentences) sentence = kicking::printable(sentence);
  return sentences;
}

/// The decision that fired, without the numbers that nobody noted.
msg::KickDecision decision_of(const KickLabel& label) {
  msg::KickDecision decision{};
  decision.robot_id = static_cast<std::uint8_t>(label.robot_id);
  decision.half = static_cast<std::uint8_t>(label.half);
  decision.policy = label.policy;
  decision.fire = true;
  decision.reason = msg::REASON_FIRE;
  decision.assignment_probability = 1.0;
  for (double* const unknown : {&decision.v0_mps, &decision.v_kick_mps, &decision.power, &decision.offset_right_m,
                                &decision.predicted_x_cross_m, &decision.predicted_z_cross_m,
                                &decision.predicted_t_flight_s, &decision.p_on_target, &decision.opponent_distance_m})
    *unknown = msg::kNone;
  return decision;
}

/// An outcome without a sighting. What was outside for no noted reason has the label unknown, and 0 as the probability
/// that it was inside (`labelled_kicks`, log/schema/reading_views.sql).
msg::KickOutcome outcome_of(const KickLabel& label) {
  msg::KickOutcome outcome{};
  outcome.robot_id = static_cast<std::uint8_t>(label.robot_id);
  outcome.outcome = label.outcome;
  outcome.on_target = label.outcome == msg::OUTCOME_ON_TARGET;
  for (double* const unknown :
       {&outcome.x_cross_m, &outcome.z_cross_m, &outcome.sd_cross_m, &outcome.exit_speed_mps,
        &outcome.exit_elevation_rad, &outcome.p_on_target, &outcome.p_wide_left, &outcome.p_wide_right, &outcome.p_over,
        &outcome.p_short, &outcome.p_post, &outcome.p_bar, &outcome.p_blocked, &outcome.residual_sd_m,
        &outcome.release_late_s, &outcome.p_saved})
    *unknown = msg::kNone;
  if (label.saved) outcome.p_saved = *label.saved ? 1.0 : 0.0;
  if (label.outside && label.outcome == msg::OUTCOME_UNKNOWN) outcome.p_on_target = 0.0;
  return outcome;
}

void write_kicks(const KickLabels& labels, const std::string& out) {
  const auto session = imported_session(labels.file, sentences_of(labels), labels.text, 0);
  RowWriting rows(out, session);
  const auto number = kicking::kick_session(static_cast<std::uint64_t>(log::session_id_of(session.uuid)));
  std::int64_t t_ns = 0;
  std::map<int, std::uint64_t> counters;  // by robot
  for (const KickLabel& label : labels.kicks) {
    const std::uint64_t n = ++counters[label.robot_id];
    if (label.time_s) t_ns = std::llround(*label.time_s * 1e9);
    const auto write = [&](auto message, std::initializer_list<std::string_view> without) {
      message.seq = n;
      message.t_ns = t_ns;
      message.kick_id = kicking::KickId{number, static_cast<std::uint8_t>(label.robot_id), n}.number();
      rows.write(message, without);
    };
    write(decision_of(label), {});
    write(outcome_of(label), {"bounced"});  // nobody noted it
  }
  rows.finish();
}

int import_kicks(const KicksArguments& arguments) {
  std::ifstream in = open_file(arguments.csv);
  const KickLabels labels = read_kick_labels(in, std::filesystem::path(arguments.csv).filename().string());
  write_kicks(labels, arguments.out);
  say(fmt::format("{}: {} kicks, labelled by {}\n", arguments.out, labels.kicks.size(),
                  fmt::join(labels.labellers(), ", ")));
  return kDone;
}

}  // namespace

void add_import_kicks(CLI::App& import, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(import, exit_code, "kicks", "Outcomes that somebody labelled by hand, from video", import_kicks);
  verb->add_option("csv", arguments->csv,
                   "Columns time (seconds, m:ss or h:mm:ss of the video, may be empty), policy, outcome (goal, saved, "
                   "inside, outside, unknown, or why it missed), by; if noted half, robot")
      ->required()
      ->type_name("CSV");
  verb->add_option("--out", arguments->out, "Match log to make, must not exist")->required()->type_name("DB");
  verb->footer(
      R"(One file is one match. trivela report shows its Table 2, trivela compare compares its policies, also over
several such logs.)");
}

}  // namespace trivela::cli
