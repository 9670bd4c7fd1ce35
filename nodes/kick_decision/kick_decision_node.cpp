#include "nodes/kick_decision/kick_decision_node.hpp"

#include <fmt/format.h>

#include <random>
#include <stdexcept>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/kick_id.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {
namespace {

/// No two nodes of a robot share one: where it is given, the second node has the next. A robot whose clock starts in
/// 1970 starts at the same seconds each time and draws.
std::uint32_t session_of_kicks(std::uint32_t given, DecisionNode which) {
  const bool second = which == DecisionNode::kSecond;
  if (given != 0) return second ? kicking::kick_session(given) : given;
  const auto now = std::chrono::system_clock::now();
  if (now < std::chrono::sys_days{std::chrono::year{2020} / 1 / 1})
    return kicking::kick_session(std::random_device{}());
  return kicking::kick_session_at(static_cast<std::uint64_t>(std::chrono::system_clock::to_time_t(now)), second);
}

void refuse_oracle(const robot::PolicyAssignment& assignment) {
  for (const kicking::PolicyName policy : assignment.candidates()) {
    if (!facts(policy).needs_truth()) continue;
    throw std::runtime_error{
        fmt::format("the policy {} needs the simulator's true state, which is not on the bus: "
                    "play it with trivela simulate",
                    kicking::name(policy))};
  }
}

void refuse_second(const NodeContext& context, DecisionNode which) {
  if (which == DecisionNode::kFirst || context.settings.kick_decision.standby) return;
  throw std::runtime_error{
      "kick_decision.standby = false: this robot has one decision node, and its driver would refuse the second's "
      "orders as unauthorised"};
}

/// Of a robot with two, so that the second one's orders are heard when the first is silent for 60 ms.
bus::WriterOptions order_options(const NodeContext& context, DecisionNode which) {
  bus::WriterOptions options;
  if (!context.settings.kick_decision.standby) return options;
  options.lease = std::chrono::milliseconds{60};
  options.strength = which == DecisionNode::kFirst ? 1 : 0;
  return options;
}

}  // namespace

KickDecisionNode::KickDecisionNode(NodeContext& context, DecisionNode which)
    : context_(context),
      which_(which),
      decider_({context.settings.kick_decision, context.settings.policy, context.settings.goal}, context.robot.model,
               context.robot_id(), session_of_kicks(context.settings.run.session, which)),
      node_(context.participant, which == DecisionNode::kFirst ? kDecisionNode : kSecondDecisionNode,
            context.robot_id()),
      decision_out_(node_.writer<msg::KickDecision>()),
      order_out_(node_.writer<msg::KickOrder>(order_options(context, which))),
      drive_out_(node_.writer<msg::DriveCommand>()),
      step_done_(step_done_writer(context, node_)),
      kicker_(node_.stores<msg::KickerStatus>()),
      outcome_(node_.stores<msg::KickOutcome>(count_observers())),
      referee_(node_.stores<msg::Referee>()),
      estimate_(node_.stores<msg::KickerEstimate>()),
      first_(context.settings.run.lockstep) {
  refuse_oracle(decider_.assignment());
  refuse_second(context_, which_);
  reject_duplicate_node(context_, order_out_, node_.name());
  if (which_ == DecisionNode::kSecond) {
    node_.on<msg::DriveCommand>([this, first = bus::owner_of_robot(kDecisionNode, context_.robot_id())](
                                    const msg::DriveCommand&, const bus::SampleInfo& info) {
      if (info.owner == first) first_node_.received(context_.steady_ns());
    });
  }
  node_.on<msg::WorldState>([this](const msg::WorldState& world) { on_world(world); },
                            bus::writes<msg::KickDecision, msg::KickOrder, msg::DriveCommand, msg::StepDone>());
}

void KickDecisionNode::on_world(const msg::WorldState& world) {
  first_.once([this] {
    expect_readers(context_, decision_out_);
    expect_readers(context_, order_out_);
    expect_readers(context_, drive_out_);
  });
  stay_alive();
  if (!context_.participant.believes(world.t_ns)) return;
  learn(world.t_ns);
  const auto status = input_of_cycle(context_, *kicker_, world.t_ns);
  const msg::KickerStatus* kicker = status ? &*status : nullptr;
  if (context_.settings.policy.rules.set_piece_s > 0.0) {
    if (const auto word = input_of_cycle(context_, *referee_, world.t_ns)) decider_.receive(*word);
  }
  const std::int64_t began_ns = context_.steady_ns();
  const robot::CycleDecision& decision = decider_.decide(world, kicker, outcome(world, kicker), nullptr, age_s(world));
  say_slow(decision.in_charge.policy, kicking::seconds(context_.steady_ns() - began_ns));
  if (in_charge()) {
    decider_.commit();
    say(world, kicker, decision);
  }
  step_done(step_done_, context_.robot_id(), msg::STEP_KICK_DECISION, world.t_ns, decider_.orders(), 0,
            decision.output.lever_kind);
}

/// Goes by what the observer has learned up to the cycle before; in lockstep the first estimate has to be there.
void KickDecisionNode::learn(std::int64_t t_ns) {
  if (context_.settings.self_calibration.mode != config::SelfCalibrationMode::kOn) return;
  const auto estimate = decider_.estimate() == 0 ? input_of_cycle(context_, *estimate_, 0) : estimate_->latest();
  if (estimate && decider_.is_news(*estimate, t_ns) && context_.participant.believes(estimate->t_ns))
    decider_.learn(*estimate);
}

/// The second node is where the first has fallen silent.
bool KickDecisionNode::in_charge() {
  if (which_ == DecisionNode::kFirst) return true;
  const bool waits = !first_node_.in_charge(context_.steady_ns());
  if (waits != std::exchange(waits_, waits)) {
    context_.logger->warn(waits ? "the first decision node is back and decides"
                                : "no first decision node is received: this one decides");
  }
  return !waits;
}

void KickDecisionNode::say(const msg::WorldState& world, const msg::KickerStatus* kicker,
                           const robot::CycleDecision& decision) {
  if (decision.order) order_out_.write(*decision.order);
  if (world.possession) decision_out_.write(decider_.record(world, kicker));
  drive(world, decision.output);
  if (!decision.order) return;
  say_unobserved();
  context_.logger->info("kick {} at t {:.3f} s: {} power {:.2f}, distance {:.2f} m", decision.order->seq,
                        kicking::seconds(world.t_ns), kicking::name(decision.in_charge.policy), decision.order->power,
                        decision.output.distance_m);
}

bus::ReaderOptions KickDecisionNode::count_observers() {
  bus::ReaderOptions options;
  options.on_liveliness = [this](const bus::Liveliness& writers) { observers_ = writers.alive; };
  return options;
}

/// A robot without a goal camera plays all the same; whoever reads its log is to know why no outcome is in it.
void KickDecisionNode::say_unobserved() {
  if (observers_ > 0 || context_.settings.run.lockstep || std::exchange(unobserved_said_, true)) return;
  context_.logger->warn(
      "nobody writes kick_outcome: no shot_observer runs, and the log has no outcome of kicks until somebody labels "
      "them "
      "(trivela import kicks)");
}

/// A policy from outside may take longer than a cycle: what it decides next is decided on an old state, and held.
void KickDecisionNode::say_slow(kicking::PolicyName policy, double took_s) {
  const double cycle_s = context_.settings.run.cycle_s;
  if (took_s <= cycle_s || context_.settings.run.lockstep || std::exchange(slow_said_, true)) return;
  context_.logger->warn("a decision of {} took {:.0f} ms, and a cycle is {:.0f} ms: later ones may hold as stale_state",
                        kicking::name(policy), 1e3 * took_s, 1e3 * cycle_s);
}

/// What waited for this process to go on is old: nothing is decided on it.
double KickDecisionNode::age_s(const msg::WorldState& world) const {
  return context_.settings.run.lockstep ? 0.0 : kicking::seconds(context_.steady_ns() - world.t_ns);
}

/// The next possession begins a second after a kick, when its outcome has long been told; in lockstep, where a second
/// may be short, the turn drive waits for it.
std::optional<msg::KickOutcome> KickDecisionNode::outcome(const msg::WorldState& world,
                                                          const msg::KickerStatus* kicker) {
  if (context_.settings.run.lockstep && decider_.awaits_outcome(world, kicker)) {
    return input_of_cycle(context_, *outcome_, decider_.last_order_t_ns());  // an outcome is of later than its order
  }
  return outcome_->latest();
}

void KickDecisionNode::drive(const msg::WorldState& world, const kicking::PolicyOutput& output) {
  msg::DriveCommand command{};
  command.robot_id = context_.robot_id();
  command.seq = ++drives_;
  command.t_ns = world.t_ns;
  command.vx_mps = output.drive.vx_mps;
  command.vy_mps = output.drive.vy_mps;
  command.omega_radps = output.drive.omega_radps;
  command.lever_kind = output.lever_kind;
  drive_out_.write(command);
}

void KickDecisionNode::stay_alive() {
  // The order topic's lease is 100 ms of real time; a loop that hangs stops asserting.
  const auto now = std::chrono::steady_clock::now();
  if (now - asserted_ < std::chrono::milliseconds(20)) return;
  order_out_.assert_liveliness();
  asserted_ = now;
}

namespace {

int decision_main(int argc, char** argv, const char* name, DecisionNode which) {
  return node_main(argc, argv, name, [which](NodeContext& context) {
    KickDecisionNode node{context, which};
    run(context, node.node());
  });
}

}  // namespace

int kick_decision_main(int argc, char** argv) { return decision_main(argc, argv, kDecisionNode, DecisionNode::kFirst); }

int kick_decision_second_main(int argc, char** argv) {
  return decision_main(argc, argv, kSecondDecisionNode, DecisionNode::kSecond);
}

}  // namespace trivela::nodes
