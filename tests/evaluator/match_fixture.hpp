#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {

/// The table of what robots learned of their kickers, every column.
inline log::TableId kicker_estimates(log::Writer& writer) {
  return writer.table("kicker_estimates", {"robot_id",
                                           "seq",
                                           "t_ns",
                                           "kick_id",
                                           "kicks",
                                           "used",
                                           "speed_ln",
                                           "elevation_rad",
                                           "direction_rad",
                                           "delay_s",
                                           "along_ratio",
                                           "sideways_ratio",
                                           "speed_ln_se",
                                           "elevation_se_rad",
                                           "direction_se_rad",
                                           "delay_se_s",
                                           "along_se_ratio",
                                           "sideways_se_ratio",
                                           "speed_sd_ratio",
                                           "elevation_sd_rad",
                                           "direction_sd_rad",
                                           "delay_sd_s",
                                           "p_mistaken",
                                           "p_jump",
                                           "chi_square"});
}

/// Writes kicks with everything that belongs to them, as a recorder would.
class MatchLog {
 public:
  using Int = std::int64_t;

  MatchLog(const std::filesystem::path& path, const log::Session& session, log::WriterOptions options = {})
      : writer_(path, session, std::move(options)),
        decisions_(
            writer_.table("kick_decisions", {"robot_id",   "seq",           "t_ns",         "kick_id",
                                             "half",       "possession_id", "policy",       "fire",
                                             "reason",     "x_m",           "y_m",          "heading_rad",
                                             "vx_mps",     "vy_mps",        "omega_radps",  "target_x_m",
                                             "target_y_m", "target_z_m",    "distance_m",   "alpha_rad",
                                             "beta_rad",   "aligned",       "left_m",       "right_m",
                                             "charge",     "shadow_count",  "fire_after_s", "assignment_probability"})),
        orders_(writer_.table("kick_orders", {"robot_id", "seq", "t_ns", "kick_id", "power", "fire_t_ns",
                                              "valid_until_t_ns", "possession"})),
        receipts_(writer_.table(
            "kick_receipts", {"robot_id", "seq", "t_ns", "kick_id", "accepted", "refusal", "order_t_ns", "fired_t_ns",
                              "release_t_ns", "power", "received_steady_ns", "fired_steady_ns"})),
        outcomes_(writer_.table("kick_outcomes",
                                {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target", "observations"})),
        truths_(writer_.table(
            "kick_truths",
            {"robot_id", "seq", "t_ns", "kick_id", "half", "possession_id", "outcome", "x_cross_m", "release_t_ns",
             "release_x_m", "release_y_m", "release_vx_mps", "release_vy_mps", "release_vz_mps", "saved", "bounced"})),
        referee_(writer_.table("referee", referee_columns())),
        statuses_(writer_.table("kicker_status",
                                {"robot_id", "seq", "t_ns", "charge", "armed", "ready", "fault", "last_kick_id",
                                 "last_accepted", "orders_handled", "orders_refused", "state", "charge_modelled"})) {}

  /// A decision that fires; returns its kick_id. Half 1 is played stopped, half 2 moving.
  Int decide(Int half) {
    const Int kick_id = ++kicks_;
    write_decision(kick_id, half);
    return kick_id;
  }

  void write_decision(Int kick_id, Int half) { write_decision(kick_id, half, kick_id, "fire"); }

  /// A decision to hold, in the possession of the kick that comes next.
  void hold(Int half, const std::string& reason = "not_aligned") { write_decision(0, half, kicks_ + 1, reason); }

  void order(Int kick_id) {
    writer_.push(orders_, {robot_id, ++seq_, t_ns(), kick_id, 20.0, t_ns(), t_ns() + 40, Int{1}});
  }

  void receipt(Int kick_id, const std::string& refusal = "none") {
    writer_.push(receipts_, {robot_id, ++seq_, t_ns(), kick_id, Int{refusal == "none" || refusal == "not_known"},
                             refusal, t_ns(), t_ns(), t_ns(), 20.0, Int{0}, Int{0}});
  }

  void outcome(Int kick_id, const std::string& label) {
    writer_.push(outcomes_, {robot_id, ++seq_, t_ns(), kick_id, label, Int{label == "on_target"}, Int{9}});
  }

  void truth(Int kick_id, const std::string& label, bool bounced = false) {
    writer_.push(truths_, {robot_id, ++seq_, t_ns(), kick_id, Int{1}, kick_id, label, 0.5, t_ns(), 0.0, 4.0, 0.0, 8.0,
                           3.0, Int{0}, Int{bounced}});
  }

  /// A kick from decision to outcome.
  Int kick(Int half, const std::string& label) {
    const Int kick_id = decide(half);
    order(kick_id);
    receipt(kick_id);
    outcome(kick_id, label);
    return kick_id;
  }

  void kicks(Int half, const std::string& label, int n) {
    for (int i = 0; i < n; ++i) kick(half, label);
  }

  void referee(double at_s, Int half, bool playing) {
    writer_.push(referee_, referee_cells(robot_id, ++seq_, static_cast<Int>(at_s * 1e9), half, playing, 0));
  }

  /// What the kicker's driver has counted so far.
  void status(Int handled, Int refused) {
    writer_.push(statuses_, {robot_id, ++seq_, t_ns(), 1.0, Int{1}, Int{1}, "none", Int{0}, Int{0}, handled, refused,
                             "ready", Int{0}});
  }

  log::Writer& writer() { return writer_; }
  void close() { writer_.finalise(); }

  Int robot_id = 1;
  double y_m = 4.0;  ///< of the robot at its next decision, in F
  double heading_rad = 0.0;

 private:
  void write_decision(Int kick_id, Int half, Int possession_id, const std::string& reason) {
    const char* const policy = half == 1 ? "stopped" : "moving";
    const Int fire = kick_id > 0 ? 1 : 0;
    writer_.push(decisions_, {robot_id, ++seq_,      t_ns(), kick_id, half, possession_id, policy, fire, reason, 0.0,
                              y_m,      heading_rad, 0.0,    0.0,     0.0,  0.0,           9.0,    0.7,  5.0,    0.0,
                              0.0,      fire,        0.3,    0.3,     1.0,  Int{0},        0.0,    1.0});
  }

  Int t_ns() const { return seq_ * 20'000'000; }

  log::Writer writer_;
  log::TableId decisions_, orders_, receipts_, outcomes_, truths_, referee_, statuses_;
  Int seq_ = 0;
  Int kicks_ = 0;
};

/// The 197 kicks of the paper's Table 2: 34 of 65 inside standing, 100 of 132 moving.
inline void write_table2(MatchLog& match) {
  match.kicks(1, "on_target", 34);
  match.kicks(1, "over", 20);
  match.kicks(1, "wide_left", 11);
  match.kicks(2, "on_target", 100);
  match.kicks(2, "post", 30);
  match.kicks(2, "short", 2);
}

}  // namespace trivela::evaluator
