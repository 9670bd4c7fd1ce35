#include "experiment/play/play_match.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "config/scenario/scenario.hpp"
#include "emulators/sim/sim_messages.hpp"
#include "experiment/play/in_process_robot.hpp"
#include "experiment/play/oracle.hpp"
#include "kicking/kick_id.hpp"
#include "kicking/random/draws.hpp"
#include "robot/observer/kick_learning.hpp"
#include "robot/observer/observer.hpp"
#include "sim/match.hpp"

namespace trivela::experiment {
namespace {

constexpr double kEndless_min = 1e6;  // a half ends by its possessions

config::Settings settings_of_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed,
                                   const PlayOptions& options) {
  config::Settings settings = config::on_field_of(scenario, settings_of(arm, options));
  settings.kick_decision.assignment_seed = seed;
  return settings;
}

bool knows_the_truth(const config::KickDecision& settings, std::uint8_t robot_id) {
  return std::ranges::any_of(robot::PolicyAssignment{settings, robot_id}.candidates(),
                             [](kicking::PolicyName policy) { return facts(policy).needs_truth(); });
}

bool somebody_knows_the_truth(const config::KickDecision& settings, const sim::Scenario& scenario) {
  for (std::uint8_t robot_id = 1; robot_id <= team_size(scenario); ++robot_id) {
    if (knows_the_truth(settings, robot_id)) return true;
  }
  return false;
}

std::uint8_t robot_of(std::int64_t kick_id) { return kicking::KickId::of(kick_id).robot_id; }

/// One match on its way.
class Game {
 public:
  Game(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
       std::uint64_t seed_of_match, std::uint32_t possessions, const PlayOptions& options, MatchRecord* record)
      : scenario_(scenario),
        arm_(arm),
        options_(options),
        record_(record),
        seed_(seed),
        match_id_(match_id),
        settings_(settings_of_match(scenario, arm, seed_of_match, options)),
        session_(kicking::kick_session(seed_of_match)),
        oracle_(somebody_knows_the_truth(settings_.kick_decision, scenario)),
        match_(scenario, seed_of_match, 1, kEndless_min, possessions),
        observer_(settings_.shot_observer, settings_.goal),
        players_(team_size(scenario)) {
    played_.match_seed = seed_of_match;
    played_.possessions.reserve(possessions);
    kick_ids_.reserve(possessions);
  }

  PlayedMatch play() {
    while (!match_.done()) cycle();
    return std::move(played_);
  }

 private:
  void cycle() {
    const bool follows = observer_.follows();
    const sim::Sensors sensors = match_.sense({.flight = follows || options_.watch});
    if (options_.watch) options_.watch(sensors);
    ++played_.cycles;
    played_.end_t_ns = sensors.t_ns;
    const msg::Referee referee = receive(sensors);
    if (follows) observe(sensors, referee);
    sim::Commands commands;
    InProcessRobot& chain = chain_of(robot_id_);
    if (oracle_) truth_ = match_.true_state();
    if (const robot::CycleDecision* decision = chain.cycle(sensors, referee, outcome_, oracle_ ? &truth_ : nullptr)) {
      commands.drive = chain.drive().twist;
      commands.lever_kind = decision->output.lever_kind;
      note_assignment(chain, decision->in_charge);
      if (record_ && chain.world().possession && (options_.every_cycle || decision->order))
        record_->decisions.push_back(chain.record());
      if (decision->order) commands.fire = send(*decision, chain);
    }
    learn(sensors.t_ns);
    settle(match_.step(commands));
  }

  /// From what was seen in this cycle, for the decisions of the next ones, as over the bus.
  void learn(std::int64_t t_ns) {
    for (const msg::KickOutcome& outcome : seen_) {
      Player& player = player_of(robot_of(outcome.kick_id));
      if (!player.learning) continue;
      const auto estimate = player.learning->seen(outcome, t_ns);
      if (!estimate) continue;
      if (record_) record_->estimates.push_back(*estimate);
      if (estimate->used) player.chain.learn(*estimate);
    }
    seen_.clear();
  }

  /// The referee's word, as everybody hears it. A new possession begins where the simulator counts one: what is paired
  /// goes by the truth's count, what a robot draws by its own.
  msg::Referee receive(const sim::Sensors& sensors) {
    msg::Referee word = hal::referee_message(sensors.t_ns, sensors.referee);
    robot_id_ = sensors.carrier;
    word.robot_id = 1;  // the whole team receives it
    word.seq = played_.cycles;
    const std::uint32_t possession_id = sensors.referee.possession_id;
    const bool again = played_.possessions.empty() || possession_id != played_.possessions.back().possession_id;
    if (again) {
      PlayedPossession next;
      next.match_id = match_id_;
      next.possession_id = possession_id;
      next.robot_id = robot_id_;
      played_.possessions.push_back(next);
      noted_ = false;
      kick_ids_.push_back(0);
    }
    if (word.playing) played_.possessions.back().played_s += scenario_.cycle_s;
    if (record_ && (again || word.playing != playing_)) record_->referee.push_back(word);
    playing_ = word.playing;
    if (!first_word_) first_word_ = word;
    return word;
  }

  void observe(const sim::Sensors& sensors, const msg::Referee& referee) {
    for (const msg::KickOutcome& outcome : observer_.frame(hal::flight_message(sensors.t_ns, sensors.flight), referee))
      take(outcome);
  }

  void take(msg::KickOutcome outcome) {
    outcome.robot_id = robot_of(outcome.kick_id);
    outcome.seq = ++outcomes_;
    outcome_ = outcome;
    seen_.push_back(outcome);
    if (record_) record_->outcomes.push_back(outcome);
    if (PlayedPossession* of = possession_of(outcome.kick_id))
      of->kick->observed = static_cast<kicking::Outcome>(outcome.outcome);
  }

  /// Gives the order to the driver and, where it accepts, to the device.
  std::optional<sim::Fire> send(const robot::CycleDecision& decision, const InProcessRobot& chain) {
    const msg::KickReceipt& receipt = *chain.receipt();
    if (record_) {
      record_->orders.push_back(*decision.order);
      record_->receipts.push_back(receipt);
    }
    if (!receipt.accepted) return std::nullopt;
    for (const msg::KickOutcome& outcome : observer_.receipt(receipt, chain.robot().model)) take(outcome);
    if (auto& learning = player_of(robot_id_).learning) {
      learning->receive(chain.record());
      learning->receive(receipt);
    }
    const kicking::PolicyOutput& output = decision.output;
    const msg::WorldState& world = chain.world();
    PlayedKick kick;
    kick.distance_m = output.distance_m;
    kick.vx_mps = world.vx_mps;
    kick.vy_mps = world.vy_mps;
    kick.omega_radps = world.omega_radps;
    kick.opponent_distance_m = world.opponent_distance_m;
    kick.power = receipt.power;
    kick.kind = receipt.kick_kind;
    kick.v_kick_mps = output.v_kick_mps.value_or(0.0);
    kick.p_on_target = output.p_on_target;
    kick.predicted = output.predicted;
    played_.possessions.back().kick = kick;
    played_.possessions.back().policy = decision.in_charge.policy;
    played_.possessions.back().assignment_probability = decision.in_charge.probability;
    kick_ids_.back() = receipt.kick_id;
    return sim::Fire{receipt.fired_t_ns, receipt.kick_id, receipt.power};
  }

  /// Who is in charge is known from the first decision in play. A robot may lose the ball and have it again in one of
  /// the simulator's possessions: what counts there is whom it put in charge first.
  void note_assignment(const InProcessRobot& chain, const robot::PolicyChance& chance) {
    const msg::WorldState& world = chain.world();
    const std::pair assigned{robot_id_, world.possession_id};
    if (assigned_ == assigned || !world.possession || !world.playing) return;
    assigned_ = assigned;
    if (!noted_) {
      noted_ = true;
      played_.possessions.back().policy = chance.policy;
      played_.possessions.back().assignment_probability = chance.probability;
    }
    if (record_)
      record_->assignments.push_back(
          {robot_id_, world.half, world.possession_id, chance.policy, chance.probability, world.t_ns});
  }

  void settle(const sim::StepEvents& events) {
    for (const sim::KickTruth& truth : events.kicks) {
      if (PlayedPossession* of = possession_of(truth.kick_id)) {
        of->kick->truth = truth.outcome;
        of->kick->truth_saved = truth.saved;
        of->kick->truth_bounced = truth.bounced;
      }
      if (!record_) continue;
      record_->kick_truths.push_back(hal::truth_message(truth));
      record_->kick_truths.back().robot_id = robot_of(truth.kick_id);
      record_->kick_truths.back().seq = ++kick_truths_;
    }
    for (const sim::PossessionTruth& truth : events.possessions) {
      PlayedPossession& current = played_.possessions.back();
      const double offset = scenario_.robot.ball_offset_m;
      current.ending = truth.ending;
      current.start_distance_m =
          std::hypot(truth.start.x_m - offset * std::sin(truth.start.heading_rad),
                     scenario_.field.goal_line_y_m - truth.start.y_m - offset * std::cos(truth.start.heading_rad));
      if (!record_) continue;
      record_->possession_truths.push_back(hal::possession_message(truth));
      record_->possession_truths.back().robot_id = truth.robot;
      record_->possession_truths.back().seq = ++possession_truths_;
    }
  }

  /// A robot and what it learns of its kicker.
  struct Player {
    InProcessRobot chain;
    std::optional<robot::KickLearning> learning;
  };

  Player& player_of(std::uint8_t robot_id) {
    std::unique_ptr<Player>& player = players_.at(robot_id - 1u);
    if (!player) begin(player, robot_id);
    return *player;
  }

  void begin(std::unique_ptr<Player>& made, std::uint8_t robot_id) {
    const config::Robot robot = robot_of(scenario_, arm_, seed_, match_id_, robot_id);
    made.reset(new Player{.chain{settings_, robot, robot_id, session_, seat(robot_id, robot.model.kinds())},
                          .learning = std::nullopt});
    Player& player = *made;
    player.chain.receive(*first_word_);
    if (settings_.self_calibration.mode == config::SelfCalibrationMode::kOff) return;
    player.learning.emplace(settings_.self_calibration, player.chain.robot().model, robot_id);
    const msg::KickerEstimate& first = player.learning->first();
    if (record_) record_->estimates.push_back(first);
    if (first.used) player.chain.learn(first);
  }

  InProcessRobot& chain_of(std::uint8_t robot_id) { return player_of(robot_id).chain; }

  std::optional<robot::GroundTruthPolicy> seat(std::uint8_t robot_id, std::size_t kinds) const {
    if (!knows_the_truth(settings_.kick_decision, robot_id)) return std::nullopt;
    return robot::GroundTruthPolicy{oracle_config(settings_.policy, scenario_),
                                    oracle_robot(scenario_, match_.true_kicker(robot_id), kinds)};
  }

  /// Whose kick it is: of this possession, or of one before, where it was seen late.
  PlayedPossession* possession_of(std::int64_t kick_id) {
    for (std::size_t i = kick_ids_.size(); i-- > 0;) {
      if (kick_ids_[i] == kick_id) return &played_.possessions[i];
    }
    return nullptr;
  }

  const sim::Scenario& scenario_;
  const Arm& arm_;
  PlayOptions options_;
  MatchRecord* record_;
  std::uint64_t seed_;
  std::uint32_t match_id_;
  config::Settings settings_;
  std::uint32_t session_;
  bool oracle_;
  sim::Match match_;
  robot::Observer observer_;
  std::vector<std::unique_ptr<Player>> players_;  // by robot, made when it first has the ball
  std::vector<msg::KickOutcome> seen_;            // in this cycle
  PlayedMatch played_;
  std::vector<std::int64_t> kick_ids_;  // by possession; 0: none
  std::optional<msg::KickOutcome> outcome_;
  sim::TrueState truth_;  // for the oracle
  std::uint8_t robot_id_ = 1;
  bool playing_ = false;
  std::optional<msg::Referee> first_word_;
  std::pair<std::uint8_t, std::uint32_t> assigned_{};  // robot and its possession
  bool noted_ = false;                                 // of the possession, who is in charge
  std::uint64_t outcomes_ = 0;
  std::uint64_t kick_truths_ = 0;
  std::uint64_t possession_truths_ = 0;
};

}  // namespace

std::uint64_t match_seed(std::uint64_t seed, std::uint32_t match_id) {
  const auto words = kicking::philox4x32({match_id, 0, 0, 0x4d415443},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[0]} << 32 | words[1]) >> 12;
}

PlayedMatch play_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed, std::uint32_t match_id,
                       std::uint32_t possessions, const PlayOptions& options, MatchRecord* record) {
  check_playable(scenario, arm, possessions);
  return Game{scenario, arm, seed, match_id, match_seed(seed, match_id), possessions, options, record}.play();
}

PlayedMatch play_seeded_match(const sim::Scenario& scenario, const Arm& arm, std::uint64_t seed,
                              std::uint32_t possessions, const PlayOptions& options, MatchRecord* record) {
  check_playable(scenario, arm, possessions);
  return Game{scenario, arm, seed, 0, seed, possessions, options, record}.play();
}

}  // namespace trivela::experiment
