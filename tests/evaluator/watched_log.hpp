#pragma once

#include <cstdint>
#include <random>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {

/// Writes kicks 6 m before the line with what was predicted of them and where they crossed: of a kicker whose balls
/// scatter by 0.1 m, and which may become another one.
class WatchedLog {
 public:
  using Int = std::int64_t;

  WatchedLog(const std::filesystem::path& path, const log::Session& session, const log::WriterOptions& options,
             std::uint32_t seed = 1, Int kicks_before = 0)
      : writer_(path, session, options),
        decisions_(writer_.table("kick_decisions", {"robot_id",
                                                    "seq",
                                                    "t_ns",
                                                    "kick_id",
                                                    "half",
                                                    "policy",
                                                    "fire",
                                                    "reason",
                                                    "x_m",
                                                    "y_m",
                                                    "heading_rad",
                                                    "vx_mps",
                                                    "vy_mps",
                                                    "omega_radps",
                                                    "target_x_m",
                                                    "target_y_m",
                                                    "target_z_m",
                                                    "distance_m",
                                                    "alpha_rad",
                                                    "beta_rad",
                                                    "aligned",
                                                    "left_m",
                                                    "right_m",
                                                    "charge",
                                                    "shadow_count",
                                                    "possession_id",
                                                    "fire_after_s",
                                                    "assignment_probability",
                                                    "predicted_x_cross_m",
                                                    "predicted_z_cross_m",
                                                    "predicted_t_flight_s"})),
        receipts_(writer_.table(
            "kick_receipts", {"robot_id", "seq", "t_ns", "kick_id", "accepted", "refusal", "order_t_ns", "fired_t_ns",
                              "release_t_ns", "power", "received_steady_ns", "fired_steady_ns"})),
        outcomes_(writer_.table("kick_outcomes", {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target",
                                                  "observations", "z_cross_m", "bounced"})),
        random_(seed),
        kicks_(kicks_before) {}

  /// So many kicks of a robot, which cross so much higher than a kicker's that is as its table says.
  void kicks(Int robot_id, int n, double higher_m = 0.0) {
    for (int i = 0; i < n; ++i) kick(robot_id, higher_m + scatter_m_(random_));
  }

  void close() { writer_.finalise(); }

 private:
  void kick(Int robot_id, double higher_m) {
    const Int kick_id = ++kicks_, seq = kick_id, t_ns = kick_id * 1'000'000'000;
    writer_.push(decisions_, {robot_id, seq, t_ns,   kick_id, Int{1}, "moving", Int{1}, "fire", 0.0, 3.0,    0.0,
                              0.0,      0.0, 0.0,    0.0,     9.0,    0.8,      6.0,    0.0,    0.0, Int{1}, 0.3,
                              0.3,      1.0, Int{0}, kick_id, 0.0,    1.0,      0.0,    0.8,    0.9});
    writer_.push(receipts_,
                 {robot_id, seq, t_ns, kick_id, Int{1}, "none", t_ns, t_ns, t_ns + 10'000'000, 20.0, Int{0}, Int{0}});
    writer_.push(outcomes_,
                 {robot_id, seq, t_ns + 900'000'000, kick_id, "on_target", Int{1}, Int{9}, 0.8 + higher_m, Int{0}});
  }

  log::Writer writer_;
  log::TableId decisions_, receipts_, outcomes_;
  std::mt19937 random_;
  std::normal_distribution<double> scatter_m_{0.0, 0.1};
  Int kicks_;  // numbered on from those of earlier sessions
};

}  // namespace trivela::evaluator
