#include "robot/decision/decider.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <type_traits>
#include <utility>

#include "idl/none.hpp"
#include "kicking/geometry/time.hpp"
#include "robot/decision/decision_message.hpp"

namespace trivela::robot {
namespace {

using kicking::PolicyName;

static_assert(std::ranges::count_if(kicking::kPolicyFacts, &kicking::PolicyFacts::rides_along) <=
                  static_cast<std::ptrdiff_t>(std::tuple_size_v<decltype(CycleDecision::shadows)>),
              "the wire carries no more shadows");
static_assert(std::ranges::none_of(kicking::kPolicyFacts,
                                   [](const kicking::PolicyFacts& facts) {
                                     return facts.rides_along && facts.needs_truth();
                                   }),
              "the truth is for who is in charge");
static_assert(std::is_trivially_destructible_v<Shadow> && std::is_trivially_destructible_v<kicking::Judgement>,
              "decide() writes over the last cycle's");

/// An instant that no gate accepts where the policy's is not one.
std::int64_t fire_t_ns(std::int64_t t_ns, double fire_after_s) {
  if (!std::isfinite(fire_after_s) || std::abs(fire_after_s) > 1.0) return t_ns - 1;
  return t_ns + kicking::nanoseconds(fire_after_s);
}

}  // namespace

Decider::Decider(const DeciderSettings& settings, const kicking::RobotModel& model, std::uint8_t robot_id,
                 std::uint32_t session, std::optional<OracleSeat> oracle)
    : model_(model),
      policy_(settings.policy),
      goal_(settings.goal),
      oracle_(std::move(oracle)),
      assignment_(settings.assignment, robot_id),
      set_piece_(settings.policy.rules.set_piece_s),
      validity_ns_(kicking::nanoseconds(settings.assignment.order_validity_s)),
      robot_id_(robot_id),
      kick_id_{session, robot_id} {
  if (!settings.assignment.shadows) return;
  for (const PolicyName policy : kicking::kEveryPolicy) {
    if (!facts(policy).rides_along || (facts(policy).needs_model() && !settings.policy.learned)) continue;
    shadows_.push_back(policy);
  }
}

/// Who is in charge of the robot's possession. They are numbered anew in each half; a policy that was not asked in
/// between must not take one for another.
void Decider::begin_possession(std::uint8_t half, std::uint32_t possession_id) {
  if (half_ == half && possession_id_ == possession_id) return;
  if (half_ != half) {
    for (kicking::PolicyMemory& memory : memory_)
      std::visit([](kicking::PossessionMemory& any) { any.possession_id.reset(); }, memory);
  }
  half_ = half;
  possession_id_ = possession_id;
  decision_.in_charge = assignment_.in_charge(half, possession_id);
}

/// Whether an order that the driver accepted of the robot's other decision node still has its time: whoever takes over
/// does not kick the same ball again.
bool Decider::kicked_by_another(std::int64_t t_ns, const msg::KickerStatus& kicker) {
  if (kicker.last_accepted && std::exchange(accepted_kick_id_, kicker.last_kick_id) != kicker.last_kick_id &&
      (orders_ == 0 || kicker.last_kick_id != last_order_.kick_id))
    anothers_t_ns_ = t_ns;
  return anothers_t_ns_ && kicking::seconds(t_ns - *anothers_t_ns_) < policy_.order_hold_s;
}

const CycleDecision& Decider::decide(const msg::WorldState& world, const msg::KickerStatus* kicker,
                                     const std::optional<msg::KickOutcome>& outcome, const kicking::PolicyInput* truth,
                                     double world_age_s) {
  begin_possession(world.half, world.possession_id);
  kicking::PolicyInput input = policy_input(world, kicker);
  if (kicker != nullptr && kicked_by_another(world.t_ns, *kicker)) input.kicker_ready = false;
  input.state_age_s = std::max(input.state_age_s, std::abs(world_age_s));
  if (const auto seen = last_kick(outcome)) input.last_kick = seen;
  input.set_piece_left_s = set_piece_.left_s(world);
  const PolicyName policy = decision_.in_charge.policy;
  const bool told = facts(policy).needs_truth();
  assert(!told || (oracle_ && truth != nullptr));
  const auto memory = [&](PolicyName of) -> kicking::PolicyMemory& { return memory_[static_cast<std::size_t>(of)]; };
  // In its place at once: a judgement is some hundred bytes, and who copies what was just written waits for it.
  new (&decision_.judgement)
      kicking::Judgement(kicking::judge(policy, told ? oracle_->policy : policy_, told ? oracle_->model : model_, goal_,
                                        told ? *truth : input, memory(policy)));
  decision_.shadow_count = 0;
  for (const PolicyName shadow : shadows_) {
    if (shadow == policy) continue;
    new (&decision_.shadows[decision_.shadow_count++])
        Shadow{shadow, kicking::judge(shadow, policy_, model_, goal_, input, memory(shadow))};
  }
  decision_.order.reset();
  const bool fire = decision_.judgement.fire;
  said_ = world.possession || fire;  // the oracle alone may fire where the robot sees no ball
  if (!said_) return decision_;
  ++decisions_;
  if (fire) decision_.order = order(world, decision_.judgement);
  return decision_;
}

void Decider::unsay() {
  if (said_) --decisions_;
  said_ = false;
  if (!decision_.order) return;
  decision_.order.reset();
  --orders_;
  last_order_ = order_before_;
  last_order_possession_id_ = possession_before_id_;
  std::visit([](kicking::PossessionMemory& any) { any.fired_t_ns.reset(); },
             memory_[static_cast<std::size_t>(decision_.in_charge.policy)]);
}

msg::KickDecision Decider::record(const msg::WorldState& world, const msg::KickerStatus* kicker) const {
  msg::KickDecision out = decision_message(world, kicker, decision_.in_charge.policy, decision_.judgement);
  out.robot_id = robot_id_;
  out.seq = decisions_;
  out.kick_id = decision_.order ? decision_.order->kick_id : 0;
  out.assignment_probability = decision_.in_charge.probability;
  for (std::size_t i = 0; i < decision_.shadow_count; ++i)
    out.shadows[i] = shadow_message(decision_.shadows[i].policy, decision_.shadows[i].judgement);
  out.shadow_count = static_cast<std::uint8_t>(decision_.shadow_count);
  return out;
}

bool Decider::awaits_outcome(const msg::WorldState& world, const msg::KickerStatus* kicker) const {
  return orders_ > 0 && assignment_.in_charge(world.half, world.possession_id).policy == PolicyName::kTurnDrive &&
         world.playing && world.possession_id != last_order_possession_id_ && kicker != nullptr &&
         kicker->last_kick_id == last_order_.kick_id && kicker->last_accepted;
}

/// What was seen of the last order's kick, once the observer has said it.
std::optional<kicking::SeenKick> Decider::last_kick(const std::optional<msg::KickOutcome>& outcome) const {
  if (orders_ == 0 || !outcome || outcome->kick_id != last_order_.kick_id) return std::nullopt;
  return kicking::SeenKick{outcome->kick_id, last_order_possession_id_, msg::optional_of(outcome->x_cross_m)};
}

msg::KickOrder Decider::order(const msg::WorldState& world, const kicking::Judgement& judgement) {
  msg::KickOrder out{};
  out.robot_id = robot_id_;
  out.seq = ++orders_;
  out.t_ns = world.t_ns;
  kick_id_.counter = orders_;
  out.kick_id = kick_id_.number();
  out.power = *judgement.power;
  out.fire_t_ns = fire_t_ns(world.t_ns, judgement.fire_after_s);
  out.valid_until_t_ns = world.t_ns + validity_ns_;
  out.possession = world.possession;
  order_before_ = std::exchange(last_order_, out);
  possession_before_id_ = std::exchange(last_order_possession_id_, world.possession_id);
  return out;
}

}  // namespace trivela::robot
