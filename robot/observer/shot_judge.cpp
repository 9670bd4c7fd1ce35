#include "robot/observer/shot_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kicking/constants.hpp"
#include "kicking/geometry/time.hpp"
#include "robot/observer/flight_hypotheses.hpp"

namespace trivela::robot {
namespace {

using kicking::Outcome;
using kicking::OutcomeProbabilities;

constexpr std::size_t kFewest = 5;         // sightings that tell of more than a turn
constexpr std::size_t kWindow = 7;         // sightings that the exit is taken from
constexpr double kNearFloor_m = 0.25;      // a minimum of z below it is a bounce
constexpr double kBeforeFrame_m = 0.15;    // the frame and the net turn a ball behind it
constexpr double kSlowestClimb_mps = 1.5;  // of a ball that leaves the floor by a kick
// What happens how often, before anything is seen.
constexpr double kBlockedAtOnce = 0.65;   // of them: before the ball was first seen in flight
constexpr double kStopped_per_s = 0.004;  // the referee stops the game for something else while the ball flies
constexpr double kAgainstTheEnd = 1e-4;   // the tracker saw the ball on the other side of the line
// Of the balls that somebody stops right before the line on their way in: few but a keeper stand there.
constexpr double kAtLeastSaved = 0.02;
constexpr double kSystematic_m = 0.01;  // of the crossing: goal, camera and ball are not known better
constexpr double kRestDoubt_mps = 0.15;
constexpr double kUntouched = 0.9;  // probability from which on a flight tells of the kicker

/// The sightings of the flight up to the first bounce: the release is only expected, so that the first ones may show
/// the ball in the handler still.
std::span<const kicking::Sighting> in_the_air(std::span<const kicking::Sighting> sightings) {
  std::size_t launch = 0;
  while (launch + 1 < sightings.size() &&
         std::min(sightings[launch].ball_m.z(), sightings[launch + 1].ball_m.z()) < kNearFloor_m) {
    ++launch;
  }
  sightings = sightings.subspan(launch);
  for (std::size_t i = kFewest; i < sightings.size(); ++i) {
    const double low = sightings[i - 1].ball_m.z();
    if (low < kNearFloor_m && low <= sightings[i - 2].ball_m.z() && low < sightings[i].ball_m.z())
      return sightings.first(i);
  }
  return sightings;
}

/// How a ball left the floor that is in this state later on.
struct FloorExit {
  double climb_mps = 0.0;  ///< upwards
  double before_s = 0.0;   ///< before the state
};

/// t of z - r - v_z t - g t^2 / 2 = 0; none: it was not kicked from there.
std::optional<FloorExit> floor_exit(const kicking::FlightState& state) {
  const double v = state.velocity_mps.z(), above_m = state.position_m.z() - kicking::Ball{}.radius_m;
  const double at_floor_mps = std::sqrt(v * v + 2.0 * kicking::kGravity_mps2 * above_m);
  if (!(at_floor_mps > kSlowestClimb_mps) || v < -0.5 * at_floor_mps) return std::nullopt;
  return FloorExit{at_floor_mps, (at_floor_mps - v) / kicking::kGravity_mps2};
}

void describe_exit(std::span<const kicking::Sighting> airborne, std::int64_t release_t_ns, ShotVerdict& verdict) {
  const auto start = kicking::fit_flight(airborne.first(std::min(airborne.size(), kWindow)), kicking::kGravity_mps2);
  if (!start || airborne.size() < kWindow) return;
  verdict.exit_speed_mps = start->velocity_mps.norm();
  verdict.exit_elevation_rad = std::atan2(start->velocity_mps.z(), start->velocity_mps.head<2>().norm());
  if (const auto floor = floor_exit(*start))
    verdict.release_late_s = kicking::seconds(airborne.front().t_ns - release_t_ns) - floor->before_s;
}

std::optional<FlightParabola> parabola_of(std::span<const kicking::Sighting> airborne, double ball_sd_m,
                                          double goal_y_m) {
  std::size_t before_line = 0;
  while (before_line < airborne.size() && airborne[before_line].ball_m.y() < goal_y_m - kBeforeFrame_m) ++before_line;
  airborne = airborne.first(before_line);
  if (airborne.size() < kWindow) return std::nullopt;
  const auto start = kicking::fit_flight(airborne, kicking::kGravity_mps2);
  if (!start) return std::nullopt;
  const auto floor = floor_exit(*start);
  if (!floor) return std::nullopt;
  const Eigen::Vector2d over_floor_mps = start->velocity_mps.head<2>();
  double mean_s = 0.0, spread_s2 = 0.0;
  const auto time_s = [&](const kicking::Sighting& s) { return kicking::seconds(s.t_ns - airborne.front().t_ns); };
  for (const kicking::Sighting& s : airborne) mean_s += time_s(s) / static_cast<double>(airborne.size());
  for (const kicking::Sighting& s : airborne) spread_s2 += (time_s(s) - mean_s) * (time_s(s) - mean_s);
  return FlightParabola{.speed_mps = std::hypot(over_floor_mps.norm(), floor->climb_mps),
                        .elevation_rad = std::atan2(floor->climb_mps, over_floor_mps.norm()),
                        .direction_rad = std::atan2(-over_floor_mps.x(), over_floor_mps.y()),
                        .sd_mps = ball_sd_m / std::sqrt(spread_s2)};
}

double& of(OutcomeProbabilities& p, Outcome outcome) { return p[static_cast<std::size_t>(outcome)]; }

/// Shares of the hypotheses, their sum not yet 1; `nothing` is that of none of the outcomes.
struct Weights {
  OutcomeProbabilities outcome{};
  double saved = 0.0;        ///< of the share on target
  double saved_early = 0.0;  ///< of that share, by a keeper before its line
  double nothing = 0.0;
};

/// The ball crossed the line: clean, or it met the frame.
void weigh_crossing(const PlaneCrossing& crossing, double log_passed, double log_back, double share, double save_ratio,
                    const kicking::Goal& goal, Weights& weights) {
  const double sd_x_m = std::hypot(crossing.sd_x_m, kSystematic_m), sd_z_m = std::hypot(crossing.sd_z_m, kSystematic_m);
  OutcomeProbabilities p = kicking::crossing_probabilities(crossing.x_m, sd_x_m, crossing.z_m, sd_z_m, goal);
  const double passed = share * std::exp(log_passed), back = share * std::exp(log_back);
  for (const Outcome outcome : {Outcome::kWideLeft, Outcome::kWideRight, Outcome::kOver})
    of(weights.outcome, outcome) = passed * of(p, outcome);
  for (const Outcome outcome : {Outcome::kPost, Outcome::kBar}) of(weights.outcome, outcome) = back * of(p, outcome);
  weights.saved = save_ratio * back * of(p, Outcome::kOnTarget);
  of(weights.outcome, Outcome::kOnTarget) = passed * of(p, Outcome::kOnTarget) + weights.saved;
}

/// A keeper before its line turned the ball, in `turn` rather than at another moment of its way there.
void weigh_save(const Turn& turn, double likelihood, double save_ratio, const kicking::Goal& goal, Weights& weights) {
  const PlaneCrossing& to = *turn.crossing;
  const double depth_s = kKeeperDepth_m / std::max(0.1, to.ball.y().v_mps);
  const OutcomeProbabilities p = kicking::crossing_probabilities(to.x_m, std::hypot(to.sd_x_m, kSystematic_m), to.z_m,
                                                                 std::hypot(to.sd_z_m, kSystematic_m), goal);
  const double saved = std::max(save_ratio, kAtLeastSaved) * std::min(1.0, turn.within_s / depth_s) * likelihood *
                       p[static_cast<std::size_t>(Outcome::kOnTarget)];
  weights.saved += saved;
  weights.saved_early += saved;
  of(weights.outcome, Outcome::kOnTarget) += saved;
}

/// Where the ball crossed, or was to cross where a keeper before its line stopped it.
const std::optional<PlaneCrossing>& crossing_of(const FlightHypotheses& told, bool saved_early) {
  if (!saved_early) return told.crossing;
  const Turn* likeliest = nullptr;
  for (const Turn& turn : told.turns) {
    if (turn.crossing && (likeliest == nullptr || turn.log_likelihood > likeliest->log_likelihood)) likeliest = &turn;
  }
  return likeliest->crossing;
}

/// Probability that the ball had come to the line when the sightings ended.
double reached(const FlightHypotheses& told, const ShotTrack& track) {
  if (!told.crossing) return 0.0;
  if (told.seen_after_crossing || track.end == FlightEnd::kBeyondLine || track.end == FlightEnd::kThrownBack)
    return 1.0;
  const double end_s = kicking::seconds(track.end_t_ns - track.release_t_ns);
  return kicking::normal_below(end_s - told.crossing->t_s, told.crossing->sd_t_s);
}

Weights weigh(const FlightHypotheses& told, const ShotTrack& track, const kicking::Goal& goal,
              const config::ShotObserver& settings) {
  Weights weights;
  const double end_s = kicking::seconds(track.end_t_ns - track.release_t_ns);
  const double there = reached(told, track);
  double log_passed = told.log_passed, log_back = told.log_thrown_back;
  if (track.end == FlightEnd::kBeyondLine) log_back += std::log(kAgainstTheEnd);
  if (track.end == FlightEnd::kThrownBack) log_passed += std::log(kAgainstTheEnd);
  // The best hypothesis has the likelihood 1, so that nothing overflows.
  double best = told.seen_after_crossing ? std::max(log_passed, log_back) : 0.0;
  for (const Turn& turn : told.turns) best = std::max(best, turn.log_likelihood);
  const double free = std::exp(-best);
  if (there > 0.0)
    weigh_crossing(*told.crossing, log_passed - best, log_back - best, there, track.save_ratio, goal, weights);

  const bool ended_free = !told.seen_after_crossing && there < 1.0;
  if (ended_free && track.end == FlightEnd::kAtRest) of(weights.outcome, Outcome::kShort) = (1.0 - there) * free;
  if (ended_free && track.end == FlightEnd::kTakenAway) {
    FlightFilter ball = told.last;
    ball.advance(std::max(0.0, end_s - told.last_t_s));
    const double sd_mps = std::hypot(kRestDoubt_mps, std::sqrt(ball.y().var_v_m2ps2));
    const double lies = kicking::normal_below(3.0 * settings.rest_speed_mps - ball.speed_mps(), sd_mps);
    of(weights.outcome, Outcome::kShort) = (1.0 - there) * free * lies;
    weights.nothing = (1.0 - there) * free * (1.0 - lies) * kStopped_per_s * end_s;
  }
  double& blocked = of(weights.outcome, Outcome::kBlocked);
  const double whole_s = std::max(told.last_t_s, 0.1);
  for (std::size_t i = 0; i < told.turns.size(); ++i) {
    const Turn& turn = told.turns[i];
    const double share = i == 0 ? kBlockedAtOnce : (1.0 - kBlockedAtOnce) * turn.within_s / whole_s;
    blocked += kTurned * share * std::exp(turn.log_likelihood - best);
    if (turn.crossing) weigh_save(turn, std::exp(turn.log_likelihood - best), track.save_ratio, goal, weights);
  }
  if (ended_free && track.end == FlightEnd::kTakenAway)
    blocked += kTurned * (1.0 - kBlockedAtOnce) * std::max(0.0, end_s - told.last_t_s) / whole_s * free;
  return weights;
}

}  // namespace

ShotVerdict judge_shot(const ShotTrack& track, const kicking::Goal& goal, const config::ShotObserver& settings) {
  ShotVerdict verdict;
  const auto airborne = in_the_air(track.sightings);
  describe_exit(airborne, track.release_t_ns, verdict);
  const auto told = flight_hypotheses(track, goal.y_m);
  if (!told) return verdict;
  verdict.residual_sd_m = told->residual_sd_m;
  verdict.bounced = told->crossing ? told->crossing->ball.bounced() : told->last.bounced();
  if (track.end == FlightEnd::kLost && !told->seen_after_crossing) return verdict;

  Weights weights = weigh(*told, track, goal, settings);
  const double sum = std::accumulate(weights.outcome.begin(), weights.outcome.end(), weights.nothing);
  if (!(sum > 0.0)) return verdict;
  for (double& p : weights.outcome) p /= sum;
  verdict.p_saved = weights.saved / sum;
  const auto likeliest = std::max_element(weights.outcome.begin(), weights.outcome.end());
  const bool turned = *likeliest == of(weights.outcome, Outcome::kBlocked) && *likeliest >= settings.label_probability;
  if (track.sightings.size() < kFewest && !turned) return {};
  if (*likeliest >= settings.label_probability)
    verdict.outcome = static_cast<Outcome>(likeliest - weights.outcome.begin());
  const double not_there =
      of(weights.outcome, Outcome::kBlocked) + of(weights.outcome, Outcome::kShort) + weights.nothing / sum;
  const double saved_early = weights.saved_early / sum;
  if (const auto& crossing = crossing_of(*told, saved_early > 0.5); crossing && not_there < 0.5) {
    verdict.x_cross_m = crossing->x_m;
    verdict.z_cross_m = crossing->z_m;
    verdict.sd_cross_m = std::max(crossing->sd_x_m, crossing->sd_z_m);
  }
  verdict.probabilities = weights.outcome;
  if (of(weights.outcome, Outcome::kBlocked) + saved_early < 1.0 - kUntouched)
    verdict.parabola = parabola_of(airborne, track.ball_sd_m, goal.y_m);
  return verdict;
}

}  // namespace trivela::robot
