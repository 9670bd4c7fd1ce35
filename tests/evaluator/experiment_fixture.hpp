#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "log/schema/digest.hpp"
#include "log/write/experiment_log.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {

/// A kick as a log has it.
struct LoggedKick {
  std::string observed = "on_target";  ///< empty: no outcome came
  std::string truth = "on_target";
  double distance_m = 4.0;
  bool saved = false;             ///< by the simulator's truth
  bool bounced = false;           ///< by the simulator's truth
  double p_saved = std::nan("");  ///< as observed
};

inline const LoggedKick kIn{"on_target", "on_target", 4.0}, kOut{"over", "over", 5.0};

/// Writes an experiment: many sessions in one file, with possessions, who was in charge of them, and their kicks.
class TestExperiment {
 public:
  using Int = std::int64_t;

  TestExperiment(const std::filesystem::path& path, Int matches)
      : log_(path, {.arguments = "test", .matches = matches}),
        decisions_(log_.table("kick_decisions", {"robot_id",    "seq",          "t_ns",
                                                 "kick_id",     "half",         "possession_id",
                                                 "policy",      "fire",         "reason",
                                                 "x_m",         "y_m",          "heading_rad",
                                                 "vx_mps",      "vy_mps",       "omega_radps",
                                                 "target_x_m",  "target_y_m",   "target_z_m",
                                                 "distance_m",  "alpha_rad",    "beta_rad",
                                                 "aligned",     "left_m",       "right_m",
                                                 "charge",      "fire_after_s", "assignment_probability",
                                                 "shadow_count"})),
        receipts_(log_.table("kick_receipts",
                             {"robot_id", "seq", "t_ns", "kick_id", "accepted", "refusal", "order_t_ns", "fired_t_ns",
                              "release_t_ns", "received_steady_ns", "fired_steady_ns", "power"})),
        outcomes_(log_.table("kick_outcomes", {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target",
                                               "observations", "p_saved"})),
        truths_(log_.table("kick_truths", {"robot_id", "seq", "t_ns", "kick_id", "half", "possession_id", "outcome",
                                           "release_t_ns", "release_x_m", "release_y_m", "release_vx_mps",
                                           "release_vy_mps", "release_vz_mps", "saved", "bounced"})),
        possessions_(log_.table("possession_truths", {"robot_id", "seq", "t_ns", "half", "possession_id", "ending",
                                                      "start_t_ns", "start_x_m", "start_y_m", "start_heading_rad"})),
        assignments_(log_.table("assignments", {"robot_id", "half", "possession_id", "policy", "probability"})),
        referee_(log_.table("referee", referee_columns())) {}

  std::string table = "new";         ///< of the next sessions
  std::string config = "a = 1\n";    ///< of the next sessions
  std::string run = "test";          ///< sessions of another run have other keys
  std::optional<Int> calibration{};  ///< calibration of the next sessions
  bool paired_halves = false;        ///< of the next sessions
  Int robot_id = 1;                  ///< of the next rows

  void begin() { log_.begin(); }
  void commit() {
    log_.end_match();
    log_.commit();
  }
  void finish() { log_.finish(); }

  /// The session that the next rows belong to. `policies`: of the halves; empty: drawn for each possession.
  void session(std::uint32_t match_id, std::uint32_t arm, const std::string& arm_name,
               std::vector<log::HalfPolicy> policies, bool numbered = true) {
    log::Session session;
    session.uuid = log::experiment_uuid(log::sha256(run), match_id, arm);
    session.simulated_clock = session.simulated = true;
    session.config_toml = config;
    session.seed = 100 + match_id;
    session.software_version = "test";
    session.scenario = "empty_field";
    session.policies = std::move(policies);
    if (!arm_name.empty()) session.arm = arm_name;
    session.kicker_table = table;
    if (numbered) session.match_id = match_id;
    session.calibration_id = calibration;
    session.paired_halves = paired_halves;
    session_id_ = log_.add_session(session, 600'000'000'000);
  }

  /// One opportunity of a robot. `probability` 1: the policy of the half.
  void possession(Int half, Int id, const std::string& policy, double probability,
                  const std::optional<LoggedKick>& kick, double start_y_m = 4.0) {
    const Int t_ns = ++seq_ * 20'000'000;
    row(possessions_, {robot_id, seq_, t_ns, half, id, kick ? "kicked" : "disputed", t_ns}, {0.5, start_y_m, 0.0});
    if (probability < 1.0) {
      auto& assigned = log_.row(assignments_, session_id_);
      assigned.integer(robot_id);
      assigned.integer(half);
      assigned.integer(id);
      assigned.text(policy.c_str());
      assigned.number(probability);
      log_.end_row();
    }
    if (!kick) return;
    const Int kick_id = seq_;
    decision(half, id, policy, probability, kick->distance_m, kick_id);
    row(receipts_, {robot_id, seq_, t_ns, kick_id, Int{1}, "none", t_ns, t_ns, t_ns, Int{0}, Int{0}}, {20.0});
    if (!kick->observed.empty()) {
      row(outcomes_, {robot_id, seq_, t_ns, kick_id, kick->observed, Int{kick->observed == "on_target"}, Int{9}},
          {kick->p_saved});
    }
    auto& t = log_.row(truths_, session_id_);
    for (const Int value : {robot_id, seq_, t_ns, kick_id, half, id}) t.integer(value);
    t.text(kick->truth.c_str());
    t.integer(t_ns);
    for (const double value : {0.0, 4.0, 0.0, 8.0, 3.0}) t.number(value);
    t.integer(kick->saved ? 1 : 0);
    t.integer(kick->bounced ? 1 : 0);
    log_.end_row();
  }

  /// A decision to hold, in a possession that is yet to end.
  void held(Int half, Int id, const std::string& policy, double probability, double distance_m) {
    ++seq_;
    decision(half, id, policy, probability, distance_m, 0);
  }

  /// The referee lets a possession of the half run from an instant for so long.
  void played_possession(Int half, Int id, double from_s, double minutes) {
    word(from_s, half, true, id);
    word(from_s + minutes * 60.0, half, false, id);
  }

  /// The referee lets a half run for so long.
  void played(Int half, double minutes) {
    word(0.0, half, true, 0);
    word(minutes * 60.0, half, false, 0);
  }

 private:
  struct Cell {
    Cell(Int value) : number(value) {}                       // NOLINT
    Cell(const char* value) : text(value) {}                 // NOLINT
    Cell(const std::string& value) : text(value.c_str()) {}  // NOLINT
    Int number = 0;
    const char* text = nullptr;
  };

  void decision(Int half, Int id, const std::string& policy, double probability, double distance_m, Int kick_id) {
    auto& d = log_.row(decisions_, session_id_);
    for (const Int value : {robot_id, seq_, seq_ * 20'000'000, kick_id, half, id}) d.integer(value);
    d.text(policy.c_str());
    d.integer(kick_id != 0 ? 1 : 0);
    d.text(kick_id != 0 ? "fire" : "waiting");
    for (const double value : {0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0, 0.7, distance_m, 0.0, 0.0}) d.number(value);
    d.integer(1);
    for (const double value : {0.3, 0.3, 1.0, 0.0, probability}) d.number(value);
    d.integer(0);
    log_.end_row();
  }

  void word(double at_s, Int half, bool playing, Int id) {
    auto& sink = log_.row(referee_, session_id_);
    const auto cells = referee_cells(1, ++seq_, static_cast<Int>(at_s * 1e9), half, playing, id);
    for (const log::Value& cell : cells) {  // texts are read where they are when the row ends
      if (const auto* const text = std::get_if<std::string>(&cell)) {
        sink.text(text->c_str());
      } else {
        sink.integer(std::get<Int>(cell));
      }
    }
    log_.end_row();
  }

  // Integers and labels first, numbers behind, as most tables have them.
  void row(std::size_t place, const std::vector<Cell>& cells, const std::vector<double>& numbers) {
    auto& sink = log_.row(place, session_id_);
    for (const Cell& cell : cells) cell.text != nullptr ? sink.text(cell.text) : sink.integer(cell.number);
    for (const double number : numbers) sink.number(number);
    log_.end_row();
  }

  log::ExperimentLog log_;
  std::size_t decisions_, receipts_, outcomes_, truths_, possessions_, assignments_, referee_;
  Int session_id_ = 0;
  Int seq_ = 0;
};

}  // namespace trivela::evaluator
