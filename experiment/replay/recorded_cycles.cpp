#include "experiment/replay/recorded_cycles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace trivela::experiment {
namespace {

constexpr double kOld_s = 1e3;  // older than any policy decides on

}  // namespace

RobotLogic::RobotLogic(const config::Settings& settings, const config::Robot& robot, std::uint8_t robot_id,
                       std::uint32_t session)
    : set_pieces_(settings.policy.rules.set_piece_s > 0.0),
      learns_(settings.self_calibration.mode == config::SelfCalibrationMode::kOn),
      robot_id_(robot_id),
      model_(settings.world_state, robot.model.ball_offset_m),
      decider_({settings.kick_decision, settings.policy, settings.goal}, robot.model, robot_id, session) {}

msg::WorldState RobotLogic::believe(const msg::Odometry& odometry, const BeliefInputs& inputs) {
  std::optional<msg::Referee> stopped;
  if (inputs.referee != nullptr && inputs.referee_silent) {
    stopped = *inputs.referee;
    stopped->playing = false;
  }
  msg::WorldState world = model_.update(odometry, inputs.frame, stopped ? &*stopped : inputs.referee, inputs.kicker);
  world.robot_id = robot_id_;
  return world;
}

LogicDecision RobotLogic::decide(const msg::WorldState& world, const DecisionInputs& inputs) {
  const auto own_kick_id = [this](std::int64_t recorded) {
    const auto own = own_kick_ids_.find(recorded);
    return own == own_kick_ids_.end() ? recorded : own->second;
  };
  std::optional<msg::KickerStatus> kicker;
  if (inputs.kicker != nullptr) {
    kicker = *inputs.kicker;
    kicker->last_kick_id = own_kick_id(kicker->last_kick_id);
  }
  std::optional<msg::KickOutcome> outcome;
  if (inputs.outcome != nullptr) {
    outcome = *inputs.outcome;
    outcome->kick_id = own_kick_id(outcome->kick_id);
  }
  if (learns_ && inputs.estimate != nullptr && decider_.is_news(*inputs.estimate, world.t_ns))
    decider_.learn(*inputs.estimate);
  if (set_pieces_ && inputs.referee != nullptr) decider_.receive(*inputs.referee);
  const robot::CycleDecision& decision =
      decider_.decide(world, kicker ? &*kicker : nullptr, outcome, nullptr, inputs.late ? kOld_s : 0.0);
  decider_.commit();
  if (decision.order && inputs.recorded_kick_id != 0) own_kick_ids_[inputs.recorded_kick_id] = decision.order->kick_id;
  return {decider_.record(world, kicker ? &*kicker : nullptr), decision.order, decision.output.drive};
}

namespace {

constexpr std::int64_t kCrossing_ns = 500'000'000;  // so long after a cycle's instant its inputs may have been taken

/// The counts of new samples that a node may have had at t_ns: first what the instants say, then what is nearest to it.
template <class T>
std::vector<std::size_t> possible_counts(InputStream<T>& stream, std::int64_t t_ns, bool lockstep) {
  const std::size_t most = stream.come_by(lockstep ? t_ns : t_ns + kCrossing_ns);
  const std::size_t usual = stream.come_by(t_ns);
  std::vector<std::size_t> counts{usual};
  for (std::size_t shift = 1; !lockstep && (usual + shift <= most || shift <= usual); ++shift) {
    if (usual + shift <= most) counts.push_back(usual + shift);
    if (shift <= usual) counts.push_back(usual - shift);
  }
  return counts;
}

/// Without the counts that give a sample which `same` takes for that of the first count.
template <class T, class Same>
std::vector<std::size_t> telling(std::vector<std::size_t> counts, const InputStream<T>& stream, Same&& same) {
  const T* const usual = stream.after(counts.front());
  std::erase_if(counts, [&](std::size_t count) {
    const T* const other = stream.after(count);
    return count != counts.front() && other != nullptr && usual != nullptr && same(*other, *usual);
  });
  return counts;
}

bool same_answer(const msg::KickerStatus& a, const msg::KickerStatus& b) {
  return a.last_kick_id == b.last_kick_id && a.last_accepted == b.last_accepted;
}

bool same_kick(const msg::KickOutcome& a, const msg::KickOutcome& b) { return a.kick_id == b.kick_id; }

template <class Row>
std::optional<Row> row_of_cycle(RowPages<Row>& rows, std::int64_t t_ns, std::int64_t* passed = nullptr) {
  while (rows.peek() != nullptr && rows.peek()->t_ns < t_ns) {
    rows.next();
    if (passed != nullptr) ++*passed;
  }
  if (rows.peek() == nullptr || rows.peek()->t_ns != t_ns) return std::nullopt;
  return rows.next();
}

bool same_decision(const msg::KickDecision& a, const msg::KickDecision& b) {
  const bool same_power = a.power == b.power || (std::isnan(a.power) && std::isnan(b.power)) ||
                          std::abs(a.power - b.power) < 1e-6 * std::abs(a.power);
  return a.policy == b.policy && a.fire == b.fire && a.reason == b.reason && (!a.fire || same_power);
}

/// Tries every one of `candidates` on a copy of the logic, until one is at no distance from what was recorded; keeps
/// what came nearest. Without a record the first one counts. Returns its place.
template <class Candidate, class Reported, class Try, class Recorded>
std::size_t nearest(std::unique_ptr<RobotLogic>& logic, const std::vector<Candidate>& candidates, Reported& said,
                    const std::optional<Recorded>& recorded, Try&& try_one) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  std::unique_ptr<RobotLogic> kept;
  for (std::size_t i = 0; i < candidates.size() && least > 0.0; ++i) {
    auto trial = std::make_unique<RobotLogic>(*logic);
    auto [what, apart] = try_one(*trial, candidates[i]);
    if (!(apart < 0.5 * least)) continue;  // what is a little nearer is so by chance
    least = apart;
    best = i;
    said = std::move(what);
    kept = std::move(trial);
    if (!recorded) break;
  }
  logic = std::move(kept);
  return best;
}

}  // namespace

RecordedCycles::RecordedCycles(const RecordedRobot& recorded, const config::Settings& settings,
                               const config::Robot& robot, std::uint32_t session)
    : lockstep_(recorded.lockstep),
      robot_id_(static_cast<std::uint8_t>(recorded.robot_id)),
      logic_(std::make_unique<RobotLogic>(settings, robot, robot_id_, session)),
      odometries_(recorded),
      worlds_(recorded),
      decisions_(recorded),
      frames_(recorded),
      referee_(recorded),
      decision_referee_(recorded),
      kicker_(recorded),
      decision_kicker_(recorded),
      outcomes_(recorded),
      estimates_(recorded) {}

bool RecordedCycles::next() {
  const auto odometry = odometries_.next();
  if (!odometry) {
    while (decisions_.next()) ++check_.without_odometry;
    return false;
  }
  odometry_ = *odometry;
  ++check_.cycles;
  crossed_ = false;
  recorded_world_ = row_of_cycle(worlds_, odometry_.t_ns);
  recorded_decision_ = row_of_cycle(decisions_, odometry_.t_ns, &check_.without_odometry);
  find_belief();
  find_decision();
  if (crossed_) ++check_.crossed;
  if (late_) ++check_.late;
  if (!recorded_decision_) return true;
  ++check_.decisions;
  if (same_decision(decided_->record, *recorded_decision_)) ++check_.decisions_same;
  if (distance(decided_->record, *recorded_decision_) == 0.0) ++check_.decisions_exact;
  return true;
}

void RecordedCycles::find_belief() {
  struct Candidate {
    std::size_t frames, referee, kicker;
    bool silent;
  };
  const std::int64_t t_ns = odometry_.t_ns;
  const auto frames = possible_counts(frames_, t_ns, lockstep_);
  const auto referee = possible_counts(referee_, t_ns, lockstep_);
  const auto kicker = telling(possible_counts(kicker_, t_ns, lockstep_), kicker_, same_answer);
  std::vector<Candidate> candidates;
  for (const std::size_t k : kicker)
    for (const std::size_t r : referee)
      for (const std::size_t f : frames) candidates.push_back({f, r, k, false});
  const msg::Referee* const word = referee_.after(referee.front());
  if (!lockstep_ && word != nullptr && word->playing)
    for (const std::size_t f : frames) candidates.push_back({f, referee.front(), kicker.front(), true});
  const std::size_t best =
      nearest(logic_, candidates, world_, recorded_world_, [&](RobotLogic& logic, const Candidate& with) {
        const msg::WorldState world = logic.believe(
            odometry_,
            {frames_.after(with.frames), referee_.after(with.referee), kicker_.after(with.kicker), with.silent});
        return std::pair{world, recorded_world_ ? distance(world, *recorded_world_) : 0.0};
      });
  const Candidate& chosen = candidates[best];
  crossed_ = chosen.frames != frames.front() || chosen.referee != referee.front() || chosen.kicker != kicker.front();
  referee_silent_ = chosen.silent;
  frames_.take(chosen.frames);
  referee_.take(chosen.referee);
  kicker_.take(chosen.kicker);
  if (!recorded_world_) return;
  ++check_.beliefs;
  if (distance(world_, *recorded_world_) == 0.0) ++check_.beliefs_same;
}

void RecordedCycles::find_decision() {
  struct Candidate {
    std::size_t kicker, referee, outcomes;
    bool late;
  };
  const std::int64_t t_ns = odometry_.t_ns;
  const auto kicker = possible_counts(decision_kicker_, t_ns, lockstep_);
  const auto referee = possible_counts(decision_referee_, t_ns, lockstep_);
  const auto outcomes = telling(possible_counts(outcomes_, t_ns, lockstep_), outcomes_, same_kick);
  estimates_.take(estimates_.come_by(t_ns - 1));  // of the cycles before
  std::vector<Candidate> candidates;
  for (const std::size_t o : outcomes)
    for (const std::size_t k : kicker)
      for (const bool late : {false, true})
        if (!late || !lockstep_) candidates.push_back({k, referee.front(), o, late});
  const std::int64_t kick_id = recorded_decision_ ? recorded_decision_->kick_id : 0;
  const std::size_t best =
      nearest(logic_, candidates, decided_, recorded_decision_, [&](RobotLogic& logic, const Candidate& with) {
        std::optional<LogicDecision> said =
            logic.decide(world_, {decision_kicker_.after(with.kicker), decision_referee_.after(with.referee),
                                  outcomes_.after(with.outcomes), estimates_.after(0), with.late, kick_id});
        const double apart = recorded_decision_ ? distance(said->record, *recorded_decision_) : 0.0;
        return std::pair{said, apart};
      });
  const Candidate& chosen = candidates[best];
  crossed_ = crossed_ || chosen.kicker != kicker.front() || chosen.outcomes != outcomes.front();
  late_ = chosen.late;
  decision_kicker_.take(chosen.kicker);
  decision_referee_.take(chosen.referee);
  outcomes_.take(chosen.outcomes);
}

BeliefInputs RecordedCycles::belief_inputs() const {
  return {frames_.after(0), referee_.after(0), kicker_.after(0), referee_silent_};
}

DecisionInputs RecordedCycles::decision_inputs() const {
  return {decision_kicker_.after(0),
          decision_referee_.after(0),
          outcomes_.after(0),
          estimates_.after(0),
          late_,
          recorded_decision_ ? recorded_decision_->kick_id : 0};
}

}  // namespace trivela::experiment
