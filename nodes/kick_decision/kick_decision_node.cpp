#include "nodes/kick_decision/kick_decision_node.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "nodes/kick_decision/decision_message.hpp"
#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
namespace {

/// session (15 bit) | robot (8 bit) | counter (40 bit), the session drawn where none was given.
std::int64_t kick_id_base(std::uint32_t session, std::uint8_t robot_id) {
  if (session == 0) session = std::random_device{}() % 0x7fff + 1;
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(session & 0x7fff) << 48) |
                                   (static_cast<std::uint64_t>(robot_id) << 40));
}

}  // namespace

KickDecisionNode::KickDecisionNode(NodeContext& context)
    : context_(context),
      node_(context.participant, "kick_decision", context.robot_id()),
      decision_out_(node_.writer<msg::KickDecision>()),
      order_out_(node_.writer<msg::KickOrder>()),
      drive_out_(node_.writer<msg::DriveCommand>()),
      step_done_(step_done_writer(context, node_)),
      kicker_(node_.stores<msg::KickerStatus>()),
      outcome_(node_.stores<msg::KickOutcome>()),
      first_(context.settings.run.lockstep),
      kick_id_base_(kick_id_base(context.settings.run.session, context.robot_id())) {
  refuse_twin(context_, order_out_, "kick_decision");
  node_.on<msg::WorldState>([this](const msg::WorldState& world) { on_world(world); },
                            bus::writes<msg::KickDecision, msg::KickOrder, msg::DriveCommand, msg::StepDone>());
}

kicking::PolicyName KickDecisionNode::in_charge(std::uint8_t half) const {
  const auto& by_half = context_.settings.kick_decision.policy_by_half;
  return by_half[std::clamp<std::size_t>(half, 1, by_half.size()) - 1];
}

void KickDecisionNode::on_world(const msg::WorldState& world) {
  first_.once([this] {
    expect_readers(decision_out_, 1);  // recorder
    expect_readers(order_out_, 2);     // kicker_driver, recorder
    expect_readers(drive_out_, 2);     // odometry, recorder
  });
  stay_alive();
  const auto status = input_of_cycle(context_, *kicker_, world.t_ns);
  const msg::KickerStatus* kicker = status ? &*status : nullptr;
  kicking::PolicyInput input = policy_input(world, kicker);
  input.last_kick = last_kick(world, kicker);
  const kicking::PolicyName chosen = in_charge(world.half);
  const auto judge = [&](kicking::PolicyName policy) {
    return kicking::judge(policy, context_.settings.policy, context_.robot.model, context_.settings.goal, input,
                          memory_[static_cast<std::size_t>(policy)]);
  };
  const kicking::Judgement judgement = judge(chosen);
  msg::KickDecision decision = decision_message(world, kicker, chosen, judgement);
  for (const kicking::PolicyName policy : kShadows) {
    if (policy == chosen || !context_.settings.kick_decision.shadows) continue;
    decision.shadows[decision.shadow_count++] = shadow_message(policy, judge(policy));
  }
  if (world.possession) {
    decision.robot_id = context_.robot_id();
    decision.seq = ++decisions_;
    if (judgement.fire) decision.kick_id = send_order(world, judgement);
    decision_out_.write(decision);
  }
  drive(world, judgement);
  step_done(step_done_, context_.robot_id(), msg::STEP_KICK_DECISION, world.t_ns, orders_);
}

/// What was seen of the last order's kick, once the observer has said it. The next possession begins a second after a
/// kick, when its outcome has long been told; in lockstep, where a second may be short, the turn drive waits for it.
std::optional<kicking::SeenKick> KickDecisionNode::last_kick(const msg::WorldState& world,
                                                             const msg::KickerStatus* kicker) {
  if (orders_ == 0) return std::nullopt;
  const bool awaited = context_.settings.run.lockstep && in_charge(world.half) == kicking::PolicyName::kTurnDrive &&
                       world.playing && world.possession_id != last_order_possession_id_ && kicker != nullptr &&
                       kicker->last_kick_id == last_order_.kick_id && kicker->last_accepted;
  // An outcome is of later than its order.
  const auto outcome = awaited ? input_of_cycle(context_, *outcome_, last_order_.t_ns) : outcome_->latest();
  if (!outcome || outcome->kick_id != last_order_.kick_id) return std::nullopt;
  kicking::SeenKick seen{outcome->kick_id, last_order_possession_id_, std::nullopt};
  if (std::isfinite(outcome->x_cross_m)) seen.x_cross_m = outcome->x_cross_m;
  return seen;
}

std::int64_t KickDecisionNode::send_order(const msg::WorldState& world, const kicking::Judgement& judgement) {
  const auto validity_ns = static_cast<std::int64_t>(context_.settings.kick_decision.order_validity_s * 1e9);
  msg::KickOrder order{};
  order.robot_id = context_.robot_id();
  order.seq = ++orders_;
  order.t_ns = world.t_ns;
  order.kick_id = kick_id_base_ + orders_;
  order.power = *judgement.power;
  order.fire_t_ns = world.t_ns;
  order.valid_until_t_ns = world.t_ns + validity_ns;
  order_out_.write(order);
  last_order_ = order;
  last_order_possession_id_ = world.possession_id;
  context_.logger->info("kick {} at t {:.3f} s: {} power {:.2f}, distance {:.2f} m", orders_,
                        static_cast<double>(world.t_ns) * 1e-9, kicking::name(in_charge(world.half)), order.power,
                        judgement.distance_m);
  return order.kick_id;
}

void KickDecisionNode::drive(const msg::WorldState& world, const kicking::Judgement& judgement) {
  msg::DriveCommand command{};
  command.robot_id = context_.robot_id();
  command.seq = ++drives_;
  command.t_ns = world.t_ns;
  command.vx_mps = judgement.drive.vx_mps;
  command.vy_mps = judgement.drive.vy_mps;
  command.omega_radps = judgement.drive.omega_radps;
  drive_out_.write(command);
}

void KickDecisionNode::stay_alive() {
  // The order topic's lease is 100 ms of real time; a loop that hangs stops asserting.
  const auto now = std::chrono::steady_clock::now();
  if (now - asserted_ < std::chrono::milliseconds(20)) return;
  order_out_.assert_liveliness();
  asserted_ = now;
}

}  // namespace trivela::nodes
