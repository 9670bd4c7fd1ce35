#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "evaluator/stats/counts/interval.hpp"
#include "experiment/play/play_match.hpp"
#include "kicking/outcome/outcome.hpp"

namespace trivela::experiment {

/// A goal camera. The observer is not told: its setting stays at 3 cm.
struct GoalCamera {
  double sd_m = 0.03;
  double frames_per_s = 50.0;
  double dropout_ratio = 0.0;
};

/// Labels beside the simulator's truth.
struct LabelCounts {
  int kicks = 0;
  int given = 0;        ///< not unknown
  int right = 0;        ///< of them
  int too_good = 0;     ///< called on target, but were not
  int too_bad = 0;      ///< were on target, but called something else
  int inside = 0;       ///< called on target, and were
  int saves_right = 0;  ///< of them, told rightly whether a keeper stopped them
  double doubt = 0.0;   ///< sum of 1 - p of the given labels: how many should be wrong
  int matches = 0;
  int covered = 0;  ///< matches whose bounds hold the true share on target
  std::map<std::pair<kicking::Outcome, kicking::Outcome>, int> confused;  ///< truth, label; where they differ

  int unknown() const { return kicks - given; }
};

/// A world that is not what robot and observer believe.
struct OtherWorld {
  const char* what = "";
  void (*change)(sim::Scenario&) = [](sim::Scenario&) {};
  bool flat = false;  ///< the robots know one kind of kick, of 6 degrees
};

/// A kicker of flat kicks on a floor with friction.
inline void kick_flat(sim::Scenario& w, double friction_ratio, double elevation_rad = 0.1047) {
  for (double& e : w.kicker.exit_elevations_rad) e = elevation_rad;
  w.ball.sliding_friction_ratio = friction_ratio;
}

/// Each belief by some three times of what is plausible, and several at once.
inline constexpr OtherWorld kOtherWorlds[] = {
    {"as believed", [](sim::Scenario&) {}},
    {"no delay", [](sim::Scenario& w) { w.kicker.delay_s = w.kicker.delay_sd_s = 0.0; }},
    {"delay 0.14 s longer", [](sim::Scenario& w) { w.kicker.delay_s += 0.14; }},
    {"delay 0.15 +- 0.06 s", [](sim::Scenario& w) { w.kicker.delay_s = 0.15, w.kicker.delay_sd_s = 0.06; }},
    {"30 % faster", [](sim::Scenario& w) { w.kicker.speed_scale_ratio = 1.3; }},
    {"30 % slower", [](sim::Scenario& w) { w.kicker.speed_scale_ratio = 0.7; }},
    {"6 degrees steeper",
     [](sim::Scenario& w) {
       for (double& e : w.kicker.exit_elevations_rad) e += 0.105;
     }},
    {"6 degrees flatter",
     [](sim::Scenario& w) {
       for (double& e : w.kicker.exit_elevations_rad) e -= 0.105;
     }},
    {"direction +- 5 degrees", [](sim::Scenario& w) { w.kicker.direction_sd_rad = 0.087; }},
    {"no drag", [](sim::Scenario& w) { w.ball.drag_coefficient = 0.0; }},
    {"three times the drag", [](sim::Scenario& w) { w.ball.drag_coefficient *= 3.0; }},
    {"bounces keep 0.45", [](sim::Scenario& w) { w.ball.restitution_ratio = 0.45; }},
    {"bounces keep 0.85", [](sim::Scenario& w) { w.ball.restitution_ratio = 0.85; }},
    {"a ball of 0.105 m", [](sim::Scenario& w) { w.ball.radius_m = 0.105; }},
    {"a ball of 0.115 m", [](sim::Scenario& w) { w.ball.radius_m = 0.115; }},
    {"gravity of 9.73 m/s2", [](sim::Scenario& w) { w.ball.gravity_mps2 = 9.73; }},
    {"gravity of 9.88 m/s2", [](sim::Scenario& w) { w.ball.gravity_mps2 = 9.88; }},
    {"camera or goal 6 cm to one side", [](sim::Scenario& w) { w.flight_camera.bias_x_m = 0.06; }},
    {"camera or goal 0.15 m before the line", [](sim::Scenario& w) { w.flight_camera.bias_y_m = -0.15; }},
    {"camera or goal 0.15 m behind the line", [](sim::Scenario& w) { w.flight_camera.bias_y_m = 0.15; }},
    {"camera or goal 6 cm too high", [](sim::Scenario& w) { w.flight_camera.bias_z_m = 0.06; }},
    {"camera or goal 6 cm too low", [](sim::Scenario& w) { w.flight_camera.bias_z_m = -0.06; }},
    {"camera 0.16 s later", [](sim::Scenario& w) { w.flight_camera.latency_s += 0.16; }},
    {"0.2 s later, 15 % faster, twice the drag, 4 degrees, 6 cm, 20 % dropouts",
     [](sim::Scenario& w) {
       w.kicker.delay_s = 0.2, w.kicker.delay_sd_s = 0.06, w.kicker.speed_scale_ratio = 1.15;
       w.ball.drag_coefficient *= 2.0, w.kicker.direction_sd_rad = 0.07;
       w.flight_camera.position_sd_m = 0.06, w.flight_camera.dropout_ratio = 0.2;
     }},
    {"0.1 s later, 10 % faster, no drag, a ball of 0.108 m, camera 4 cm off each way",
     [](sim::Scenario& w) {
       w.kicker.delay_s = 0.16, w.kicker.speed_scale_ratio = 1.1, w.ball.drag_coefficient = 0.0,
       w.ball.radius_m = 0.108;
       w.flight_camera.bias_x_m = w.flight_camera.bias_y_m = w.flight_camera.bias_z_m = 0.04;
     }},
    {"a keeper", [](sim::Scenario& w) { w.keeper.enabled = true; }},
    {"a keeper 0.5 m before its line",
     [](sim::Scenario& w) {
       w.keeper.enabled = true;
       w.keeper.advance_m = 0.5;
     }},
    {"flat kicks", [](sim::Scenario& w) { kick_flat(w, 0.3); }, true},
    {"flat kicks, hardly any friction", [](sim::Scenario& w) { kick_flat(w, 0.05); }, true},
    {"flat kicks, twice the friction", [](sim::Scenario& w) { kick_flat(w, 0.6); }, true},
    {"flat kicks of 12 degrees", [](sim::Scenario& w) { kick_flat(w, 0.3, 0.21); }, true},
    {"flat kicks that roll, 0.1 s later, 15 % faster, 4 degrees, 6 cm, 20 % dropouts",
     [](sim::Scenario& w) {
       kick_flat(w, 0.5, 0.0);
       w.kicker.delay_s = 0.16, w.kicker.speed_scale_ratio = 1.15, w.kicker.direction_sd_rad = 0.07;
       w.flight_camera.position_sd_m = 0.06, w.flight_camera.dropout_ratio = 0.2;
     },
     true},
};

/// Adds one match of `possessions` possessions; odd matches are played by moving, even ones and all with flat kicks by
/// predictive.
inline void add_match(const GoalCamera& camera, std::uint64_t seed, std::uint32_t match_id, std::uint32_t possessions,
                      LabelCounts& counts, const OtherWorld& world = {}) {
  sim::Scenario scenario;
  scenario.flight_camera.position_sd_m = camera.sd_m;
  scenario.flight_camera.period_s = 1.0 / camera.frames_per_s;
  scenario.flight_camera.dropout_ratio = camera.dropout_ratio;
  world.change(scenario);
  Arm arm;
  arm.policy = match_id % 2 == 0 ? kicking::PolicyName::kPredictive : kicking::PolicyName::kMoving;
  if (world.flat) {
    arm.policy = kicking::PolicyName::kPredictive;
    arm.robots.front().model.exit_angle_rad = kicking::radians(6.0);
  }
  if (camera.frames_per_s > 50.0) scenario.cycle_s = arm.settings.run.cycle_s = 1.0 / camera.frames_per_s;
  MatchRecord record;
  play_match(scenario, arm, seed, match_id, possessions, {}, &record);
  std::map<std::int64_t, const msg::KickOutcome*> observed;
  for (const msg::KickOutcome& outcome : record.outcomes) observed[outcome.kick_id] = &outcome;
  evaluator::stats::DoubtfulCounts match;
  int kicks = 0, inside = 0;
  for (const msg::KickTruth& truth : record.kick_truths) {
    const auto found = observed.find(truth.kick_id);
    const auto label =
        found == observed.end() ? kicking::Outcome::kUnknown : static_cast<kicking::Outcome>(found->second->outcome);
    const auto true_one = static_cast<kicking::Outcome>(truth.outcome);
    const bool is_in = true_one == kicking::Outcome::kOnTarget;
    ++kicks;
    inside += is_in;
    if (label == kicking::Outcome::kUnknown) {
      ++match.unknown;
      continue;
    }
    const msg::KickOutcome& out = *found->second;
    const double p[] = {out.p_on_target, out.p_wide_left, out.p_wide_right, out.p_over,
                        out.p_short,     out.p_post,      out.p_bar,        out.p_blocked};
    const bool called_in = label == kicking::Outcome::kOnTarget;
    ++match.known.n;
    match.known.inside += called_in;
    (called_in ? match.doubt.inside : match.doubt.outside) += called_in ? 1.0 - out.p_on_target : out.p_on_target;
    ++counts.given;
    if (called_in && is_in) {
      ++counts.inside;
      counts.saves_right += (out.p_saved > 0.5 * out.p_on_target) == truth.saved;
    }
    counts.doubt += 1.0 - p[static_cast<int>(label)];
    counts.right += label == true_one;
    counts.too_good += called_in && !is_in;
    counts.too_bad += is_in && !called_in;
    if (label != true_one) ++counts.confused[{true_one, label}];
  }
  counts.kicks += kicks;
  if (kicks == 0) return;
  const auto bounds = evaluator::stats::efficiency_bounds(match);
  const double share = static_cast<double>(inside) / kicks;
  ++counts.matches;
  counts.covered += bounds.lo <= share + 1e-12 && share <= bounds.hi + 1e-12;
}

}  // namespace trivela::experiment
