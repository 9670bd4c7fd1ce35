#include "sim/match.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "kicking/geometry/time.hpp"
#include "sim/kicker/kicker.hpp"
#include "sim/laser/laser.hpp"
#include "sim/opportunity.hpp"
#include "sim/scenario_fields.hpp"
#include "sim/sensor_suite.hpp"
#include "sim/world.hpp"

namespace trivela::sim {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr int kHalfShift = 24;  // a half has fewer possessions than 2^24

/// The first nanosecond that lies `wait_s` or more after `start_t_ns`.
std::int64_t instant_after(std::int64_t start_t_ns, double wait_s) {
  return wait_s < 1e6 ? start_t_ns + static_cast<std::int64_t>(std::ceil(wait_s * 1e9)) : kNever;
}

const Scenario& playable(const Scenario& scenario) {
  if (const auto problem = first_problem(scenario)) {
    throw std::runtime_error{fmt::format("scenario: {}: {}", problem->key, problem->why)};
  }
  return scenario;
}

}  // namespace

struct Match::State {
  enum class Phase { kStop, kPlay, kClosing, kDone };  // kClosing: the stop that ends a half

  State(const Scenario& values, std::uint64_t match_seed, int half_count, double half_minutes,
        std::uint32_t possession_limit, bool halves_paired)
      : scenario(playable(values)),
        seed(match_seed),
        halves(half_count),
        half_ns(kicking::nanoseconds(half_minutes * 60.0)),
        max_possessions(possession_limit),
        paired_halves(halves_paired),
        cycle_ns(kicking::nanoseconds(values.cycle_s)),
        substeps(static_cast<std::int64_t>(std::ceil(values.cycle_s / values.substep_s - 1e-9))),
        time_limit_ns(kicking::nanoseconds(values.possession.time_limit_s)),
        world(scenario),
        sensors(scenario),
        laser(scenario.laser, scenario.ball.radius_m) {
    if (halves < 1 || halves > 255) throw std::runtime_error{fmt::format("halves: {} is outside 1..255", halves)};
    if (!(half_minutes > 0.0 && half_minutes <= 1e6)) {
      throw std::runtime_error{fmt::format("half_minutes: {} is outside 0..1e6", half_minutes)};
    }
    for (std::uint32_t robot = 1; robot <= static_cast<std::uint32_t>(scenario.team.robots); ++robot)
      kickers.push_back(match_kicker(scenario, robot, seed));
    kicked.resize(kickers.size());
    begin_possession();
  }

  // The flow: stop -> play -> stop ... -> closing -> next half.

  void begin_possession() {
    ++possession_id;
    ++commands;
    phase = Phase::kStop;
    ending.reset();
    const kicking::Draws draws{seed, situation()};
    opportunity = draw_opportunity(scenario, draws);
    if (scenario.referee.set_pieces) opportunity.velocity = {};  // who takes it stands
    world.place(opportunity, speed_scale_now(opportunity.robot), draws);
    sensors.begin(draws);
    laser.begin(draws);
    sensors.remember(world);
    stop_until_t_ns = world.t_ns() + kicking::nanoseconds(scenario.possession.stop_s);
    if (scenario.possession.stop_s <= 0.0) start_play();
  }

  /// The speeds of a robot's kicker, of those of the scenario, as its kicks have worn them.
  double speed_scale_now(std::uint32_t robot) const {
    const Kicker& kicker = kickers.at(robot - 1);
    return kicker.speed_scale_ratio * worn_ratio(kicker, kicked.at(robot - 1));
  }

  /// Number of the possession's situation: in the first half its own.
  std::uint32_t situation() const {
    return paired_halves ? possession_id : static_cast<std::uint32_t>(half - 1) << kHalfShift | possession_id;
  }

  void start_play() {
    phase = Phase::kPlay;
    ++commands;
    play_t_ns = world.t_ns();
    if (!half_play_t_ns) half_play_t_ns = play_t_ns;
    world.start_play(opportunity);
    const double free_s = challenger().time_until_s(scenario.opponent.dispute_distance_m);
    dispute_t_ns = instant_after(play_t_ns, free_s);
    whistle_t_ns = instant_after(play_t_ns, std::min(opportunity.whistle_s, set_piece_s()));
  }

  /// Within which a set piece has to be taken [s].
  double set_piece_s() const {
    const bool limited = scenario.referee.set_pieces && scenario.rules.set_piece_s > 0.0;
    return limited ? scenario.rules.set_piece_s : std::numeric_limits<double>::infinity();
  }

  const OpponentBody& challenger() const { return world.opponents().first_at(scenario.opponent.dispute_distance_m); }

  /// Plays one cycle, stopping at every instant at which the possession may end.
  void play_cycle(StepEvents& events) {
    const std::int64_t start = world.t_ns();
    for (std::int64_t i = 1; i <= substeps; ++i) {
      const std::int64_t until = start + cycle_ns * i / substeps;
      while (world.t_ns() < until) {
        world.advance_to(std::min(until, next_end_t_ns()));
        watch(events);
      }
      sensors.remember(world);
      laser.see(world.t_ns(), world.ball_m());
    }
    sensors.next_cycle();
  }

  /// When the dispute, the whistle or the time limit is due, if that is ahead; never otherwise.
  std::int64_t next_end_t_ns() const {
    if (phase != Phase::kPlay || ending || world.shot()) return kNever;
    const std::int64_t due = std::min({dispute_t_ns, whistle_t_ns, play_t_ns + time_limit_ns});
    return due > world.t_ns() ? due : kNever;
  }

  void close_half() {
    phase = Phase::kClosing;
    ++commands;
    stop_until_t_ns = world.t_ns() + kicking::nanoseconds(scenario.possession.stop_s);
    world.stop_play();
  }

  void open_half() {
    if (half == halves) {
      phase = Phase::kDone;
      return;
    }
    ++half;
    half_start_t_ns = world.t_ns();
    half_play_t_ns.reset();
    possession_id = 0;
    begin_possession();
  }

  /// Looks at the world after it has moved.
  void watch(StepEvents& events) {
    if (phase != Phase::kPlay || ending) return;
    if (const auto& shot = world.shot()) {
      if (!shot->result()) return;
      const ShotResult& result = *shot->result();
      const bool counts = !scenario.rules.opponents_half_only || shot->released().position_m.y() > 0.0;
      if (result.outcome == kicking::Outcome::kOnTarget && !result.saved && counts) ++goals;
      ++kicked[opportunity.robot - 1u];
      events.kicks.push_back({.t_ns = result.t_ns,
                              .kick_id = world.shot_kick_id(),
                              .half = half,
                              .possession_id = possession_id,
                              .outcome = result.outcome,
                              .crossing = result.crossing,
                              .saved = result.saved,
                              .bounced = result.bounced,
                              .release_t_ns = shot->release_t_ns(),
                              .release_position_m = shot->released().position_m,
                              .release_velocity_mps = shot->released().velocity_mps,
                              .margin_m = result.margin_m});
      return end(PossessionEnd::kKicked, scenario.possession.after_crossing_s, events);
    }
    if (world.kicker().stroke() && world.kicker().stroke()->live) return;  // the ball leaves first
    if (world.t_ns() >= dispute_t_ns) return end(PossessionEnd::kDisputed, 0.0, events);
    if (world.t_ns() >= whistle_t_ns) return end(PossessionEnd::kStopped, 0.0, events);
    const Eigen::Vector3d ball = world.ball_m();
    const bool carried_out =
        std::abs(ball.x()) > scenario.field.side_line_x_m || std::abs(ball.y()) > scenario.field.goal_line_y_m;
    if (carried_too_far(ball.head<2>())) return end(PossessionEnd::kStopped, 0.0, events);
    if (carried_out || world.t_ns() - play_t_ns >= time_limit_ns) {
      end(PossessionEnd::kTimedOut, 0.0, events);
    }
  }

  bool carried_too_far(const Eigen::Vector2d& ball_m) const {
    const double limit_m = scenario.rules.carry_limit_m;
    if (limit_m <= 0.0) return false;
    const Eigen::Vector2d taken = kicking::to_field(opportunity.start, {0.0, scenario.robot.ball_offset_m});
    return (ball_m - taken).norm() > limit_m;
  }

  void end(PossessionEnd how, double play_on_s, StepEvents& events) {
    ending = how;
    if (how != PossessionEnd::kKicked) world.stop_play();
    play_until_t_ns = world.t_ns() + kicking::nanoseconds(play_on_s);
    events.possessions.push_back({.t_ns = world.t_ns(),
                                  .half = half,
                                  .possession_id = possession_id,
                                  .ending = how,
                                  .robot = opportunity.robot,
                                  .start_t_ns = play_t_ns,
                                  .start = opportunity.start});
  }

  /// Moves the flow on at the end of a cycle, which is when the referee is heard.
  void referee() {
    const std::int64_t now = world.t_ns();
    if (phase == Phase::kStop && now >= stop_until_t_ns) return start_play();
    if (phase == Phase::kClosing && now >= stop_until_t_ns) return open_half();
    if (phase != Phase::kPlay || !ending || now < play_until_t_ns) return;
    const bool enough = max_possessions > 0 && possession_id >= max_possessions;
    if (enough || now - half_start_t_ns >= half_ns) return close_half();
    begin_possession();
  }

  RefereeState word() const {
    RefereeState said{half, phase == Phase::kPlay, possession_id, goals, commands, {}, false};
    said.set_piece = scenario.referee.set_pieces && phase == Phase::kStop;
    if (half_play_t_ns) said.half_s = kicking::seconds(world.t_ns() - *half_play_t_ns);
    return said;
  }

  Scenario scenario;
  std::uint64_t seed;
  int halves;
  std::int64_t half_ns;
  std::uint32_t max_possessions;
  bool paired_halves;
  std::int64_t cycle_ns;
  std::int64_t substeps;
  std::int64_t time_limit_ns;
  World world;
  SensorSuite sensors;
  FieldLaser laser;
  std::vector<Kicker> kickers;        // by robot, as the match began
  std::vector<std::uint32_t> kicked;  // by robot: kicks whose ball left

  Phase phase = Phase::kStop;
  int half = 1;
  std::int64_t half_start_t_ns = 0;
  std::optional<std::int64_t> half_play_t_ns;  // its first start of play
  std::uint32_t possession_id = 0;
  std::uint32_t goals = 0;
  std::uint32_t commands = 0;
  Opportunity opportunity;
  std::int64_t stop_until_t_ns = 0;
  std::int64_t play_t_ns = 0;
  std::int64_t play_until_t_ns = 0;
  std::int64_t dispute_t_ns = kNever;
  std::int64_t whistle_t_ns = kNever;
  std::optional<PossessionEnd> ending;
};

Match::Match(const Scenario& scenario, std::uint64_t seed, int halves, double half_minutes,
             std::uint32_t max_possessions, bool paired_halves)
    : state_(std::make_unique<State>(scenario, seed, halves, half_minutes, max_possessions, paired_halves)) {}
Match::~Match() = default;
Match::Match(Match&&) noexcept = default;
Match& Match::operator=(Match&&) noexcept = default;

bool Match::done() const { return state_->phase == State::Phase::kDone; }

Sensors Match::sense(const SensorChoice& choice) const {
  const State& s = *state_;
  return {.t_ns = s.world.t_ns(),
          .carrier = s.opportunity.robot,
          .wheels = choice.wheels ? s.sensors.wheels(s.world) : WheelSample{},
          .kicker = {.charge = s.world.kicker().charge(),
                     .lever = s.scenario.kicker.flat.enabled,
                     .lever_kind = s.world.kicker().lever_kind(s.world.t_ns())},
          .vision = choice.vision ? s.sensors.vision(s.world) : VisionFrame{},
          .flight = choice.flight ? s.sensors.flight(s.world) : FlightFrame{},
          .referee = s.word(),
          .scans = s.laser.scans()};
}

Kicker Match::true_kicker(std::uint32_t robot) const {
  Kicker kicker = state_->kickers.at(robot - 1);
  kicker.speed_scale_ratio = state_->speed_scale_now(robot);
  return kicker;
}

TrueState Match::true_state() const {
  const State& s = *state_;
  TrueState state{.pose = s.world.body().pose(),
                  .twist = s.world.body().twist(),
                  .ball_held = !s.world.shot(),
                  .charge = s.world.kicker().charge(),
                  .lever_kind = s.world.kicker().lever_kind(s.world.t_ns()),
                  .opponent_distance_m = s.challenger().distance_m(),
                  .opponent_closing_mps = s.challenger().closing_mps(),
                  .keeper_x_m = s.scenario.keeper.enabled
                                    ? kicking::OptionalDouble(keeper_place(s.scenario, s.world.ball_m()).x_m)
                                    : std::nullopt,
                  .dispute_t_ns = s.dispute_t_ns};
  for (const OpponentBody& body : s.world.opponents().all())
    state.opponents[state.opponent_count++] = {{body.position().x_m, body.position().y_m}, body.closing_mps(), 0.0};
  return state;
}

StepEvents Match::step(const Commands& commands) {
  State& s = *state_;
  assert(!done());
  StepEvents events;
  s.world.command(commands);
  s.laser.forget();
  s.play_cycle(events);
  s.referee();
  return events;
}

}  // namespace trivela::sim
