#include "robot/decision/decider.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "config/text/error.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/in_place.hpp"
#include "robot/decision/decision_message.hpp"
#include "robot/observer/kick_learning.hpp"

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

/// An instant that no gate accepts where the policy's is not one.
std::int64_t fire_t_ns(std::int64_t t_ns, double fire_after_s) {
  if (!std::isfinite(fire_after_s) || std::abs(fire_after_s) > 1.0) return t_ns - 1;
  return t_ns + kicking::nanoseconds(fire_after_s);
}

}  // namespace

Decider::Decider(const DeciderSettings& settings, const kicking::RobotModel& model, std::uint8_t robot_id,
                 std::uint32_t session, std::optional<GroundTruthPolicy> oracle)
    : model_(model),
      policy_(settings.policy),
      goal_(settings.goal),
      oracle_(std::move(oracle)),
      assignment_(settings.assignment, robot_id),
      set_piece_(settings.policy.rules.set_piece_s),
      keeper_habit_(settings.policy.keeper),
      validity_ns_(kicking::nanoseconds(settings.assignment.order_validity_s)),
      robot_id_(robot_id),
      session_(session) {
  for (const PolicyName policy : assignment_.candidates()) {
    if (!facts(policy).needs_program()) continue;
    throw config::Error{fmt::format("the policy {} is another program's: use that program in place of this one",
                                    kicking::name(policy))};
  }
  memory_.reserve(kicking::policies().size());
  for (std::size_t place = 0; place < kicking::policies().size(); ++place) {
    const auto policy = static_cast<PolicyName>(place);
    memory_.emplace_back(policy);
    const bool needs_more = facts(policy).needs_model() && !settings.policy.learned;
    if (settings.assignment.shadows && facts(policy).rides_along && !needs_more) shadows_.push_back(policy);
  }
}

/// Who is in charge of the robot's possession. They are numbered again in each half; a policy that was not asked in
/// between must not take one for another.
void Decider::begin_possession(std::uint8_t half, std::uint32_t possession_id) {
  if (half_ == half && possession_id_ == possession_id) return;
  if (half_ != half) {
    for (kicking::PolicyMemory& memory : memory_) memory.get()->possession_id.reset();
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
  see_last_kick(outcome, input);
  see_keeper(kicker, input);
  input.set_piece_left_s = set_piece_.left_s(world);
  const PolicyName policy = decision_.in_charge.policy;
  const bool told = facts(policy).needs_truth();
  assert(!told || (oracle_ && truth != nullptr));
  kicking::make_in_place(decision_.output, [&] {
    return kicking::evaluate(policy, told ? oracle_->policy : policy_, told ? oracle_->model : model_of(policy), goal_,
                             told ? *truth : input, memory(policy));
  });
  judge_shadows(input);
  decision_.order.reset();
  const kicking::PolicyOutput& output = decision_.output;
  counts_ = world.possession || output.fire;  // the oracle alone may fire where the robot sees no ball
  if (!output.fire) return decision_;
  fired_t_ns_ = std::exchange(last_fire(policy), std::nullopt);  // pending for the policy once it is committed
  msg::KickOrder& order = decision_.order.emplace();
  order.robot_id = robot_id_;
  order.seq = orders_ + 1;
  order.t_ns = world.t_ns;
  order.kick_id = kicking::KickId{session_, robot_id_, order.seq}.number();
  order.power = *output.power;
  order.fire_t_ns = fire_t_ns(world.t_ns, output.fire_after_s);
  order.valid_until_t_ns = world.t_ns + validity_ns_;
  order.possession = world.possession;
  order.kick_kind = output.kick_kind;
  return decision_;
}

void Decider::learn(const msg::KickerEstimate& estimate) {
  const kicking::KickerEstimate learned = estimate_of(estimate);
  if (!kicking::valid(learned)) return;
  corrected_ = kicking::corrected(model_, learned);
  estimate_ = static_cast<std::uint32_t>(estimate.seq);
}

void Decider::judge_shadows(const kicking::PolicyInput& input) {
  decision_.shadow_count = 0;
  for (const PolicyName shadow : shadows_) {
    if (shadow == decision_.in_charge.policy) continue;
    kicking::make_in_place(decision_.shadows[decision_.shadow_count++], [&] {
      return Shadow{shadow, kicking::evaluate(shadow, policy_, model_of(shadow), goal_, input, memory(shadow))};
    });
  }
}

void Decider::commit() {
  if (counts_) ++decisions_;
  counts_ = false;
  if (!decision_.order || decision_.order->seq == orders_) return;
  ++orders_;
  last_order_ = *decision_.order;
  last_order_possession_id_ = possession_id_;
  last_fire(decision_.in_charge.policy) = fired_t_ns_;
  keeper_habit_.kicked(last_order_.fire_t_ns + kicking::nanoseconds(model_.kind(last_order_.kick_kind).delay_s),
                       decision_.output.predicted ? decision_.output.predicted->x_m : decision_.output.target_x_m);
}

std::optional<std::int64_t>& Decider::last_fire(PolicyName policy) { return memory(policy).get()->fired_t_ns; }

msg::KickDecision Decider::record(const msg::WorldState& world, const msg::KickerStatus* kicker) const {
  msg::KickDecision out = decision_message(world, kicker, decision_.in_charge.policy, decision_.output);
  out.robot_id = robot_id_;
  out.seq = decisions_;
  out.kick_id = decision_.order ? decision_.order->kick_id : 0;
  out.assignment_probability = decision_.in_charge.probability;
  out.estimate = estimate_;
  for (std::size_t i = 0; i < decision_.shadow_count; ++i)
    out.shadows[i] = shadow_message(decision_.shadows[i].policy, decision_.shadows[i].output);
  out.shadow_count = static_cast<std::uint8_t>(decision_.shadow_count);
  return out;
}

bool Decider::awaits_outcome(const msg::WorldState& world, const msg::KickerStatus* kicker) const {
  return orders_ > 0 && assignment_.in_charge(world.half, world.possession_id).policy == PolicyName::kTurnDrive &&
         world.playing && world.possession_id != last_order_possession_id_ && kicker != nullptr &&
         kicker->last_kick_id == last_order_.kick_id && kicker->last_accepted;
}

bool Decider::reads_opponents() const {
  const auto reads = [](PolicyName policy) { return facts(policy).reads_opponents; };
  return std::ranges::any_of(assignment_.candidates(), reads) || std::ranges::any_of(shadows_, reads);
}

/// What the keeper does, and did after the last order's kick where the driver accepted it.
void Decider::see_keeper(const msg::KickerStatus* kicker, kicking::PolicyInput& input) {
  if (!input.playing) keeper_habit_.forget_kick();
  if (kicker != nullptr && kicker->last_accepted && kicker->last_kick_id == last_order_.kick_id)
    keeper_habit_.see(input.t_ns, input.keeper);
  if (input.keeper) input.keeper->guesses = keeper_habit_.guesses();
}

/// What was seen of the last order's kick, once the observer has said it.
void Decider::see_last_kick(const std::optional<msg::KickOutcome>& outcome, kicking::PolicyInput& input) const {
  if (orders_ == 0 || !outcome || outcome->kick_id != last_order_.kick_id) return;
  input.last_kick.emplace(kicking::SeenKick{outcome->kick_id, last_order_possession_id_, outcome->x_cross_m});
}

}  // namespace trivela::robot
