#include "robot/decision/decision_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>

#include "kicking/geometry/time.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::robot {
namespace {

/// The names of the wire: those of the rows, and one for all from outside.
constexpr std::array kWireNames = [] {
  std::array<const char*, kicking::kPolicyCount + 1> names{};
  std::ranges::copy(kicking::kPolicyNames, names.begin());
  names.back() = "own";
  return names;
}();
static_assert(bus::has_labels<msg::Policy>(kWireNames));
static_assert(bus::has_labels<msg::DecisionReason>(kicking::kReasonNames));

constexpr bool to_message(bool value) { return value; }
constexpr double to_message(double value) { return value; }
constexpr std::uint8_t to_message(std::uint8_t value) { return value; }
constexpr double to_message(kicking::OptionalDouble value) { return value.to_message(); }
msg::DecisionReason to_message(kicking::Reason reason) { return to_wire(reason); }

/// Place of the message's field of that name; their number: it has none.
template <class Message>
constexpr std::size_t place_of(std::string_view name) {
  std::size_t place = 0;
  for (const bus::Field& field : bus::meta<Message>::fields) {
    if (field.name == name) break;
    ++place;
  }
  return place;
}

template <std::size_t I, class Message>
void copy_field(const kicking::PolicyOutput& output, Message& out) {
  constexpr auto& field = std::get<I>(kicking::kRecordedFields);
  constexpr std::size_t place = place_of<Message>(field.name);
  if constexpr (place < bus::meta<Message>::fields.size())
    out.*std::get<place>(bus::meta<Message>::members) = to_message(std::invoke(field.get, output));
}

/// What the message has of the output, by the names of the fields.
template <class Message>
void copy_fields(const kicking::PolicyOutput& output, Message& out) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (copy_field<I>(output, out), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(kicking::kRecordedFields)>>{});
}

}  // namespace

msg::Policy to_wire(kicking::PolicyName policy) {
  return from_outside(policy) ? msg::POLICY_OWN : static_cast<msg::Policy>(policy);
}
msg::DecisionReason to_wire(kicking::Reason reason) { return static_cast<msg::DecisionReason>(reason); }

kicking::PolicyInput policy_input(const msg::WorldState& world, const msg::KickerStatus* kicker) {
  kicking::PolicyInput in;
  in.t_ns = world.t_ns;
  in.pose = {world.x_m, world.y_m, world.heading_rad};
  in.twist = {world.vx_mps, world.vy_mps, world.omega_radps};
  in.playing = world.playing;
  in.possession = world.possession;
  in.possession_id = world.possession_id;
  in.kicker_ready = kicker != nullptr && kicker->ready;
  if (kicker != nullptr) in.lever_kind = kicker->lever_kind;
  if (kicker != nullptr) in.state_age_s = std::abs(kicking::seconds(world.t_ns - kicker->t_ns));
  in.sd_position_m = world.sd_position_m;
  in.sd_heading_rad = world.sd_heading_rad;
  in.opponent_distance_m = world.opponent_distance_m;
  const Eigen::Vector2d ball_m{world.ball_x_m, world.ball_y_m}, ball_mps{world.ball_vx_mps, world.ball_vy_mps};
  const std::size_t tracked = std::min<std::size_t>(world.opponent_count, kicking::kMostBodies);
  for (std::size_t i = 0; i < tracked; ++i) {
    kicking::BodyPlace place{{world.opponent_x_m[i], world.opponent_y_m[i]}, 0.0, world.opponent_sd_m[i]};
    const Eigen::Vector2d apart_m = place.position_m - ball_m;
    const Eigen::Vector2d apart_mps = Eigen::Vector2d{world.opponent_vx_mps[i], world.opponent_vy_mps[i]} - ball_mps;
    place.closing_mps = -apart_mps.dot(apart_m) / std::max(0.1, apart_m.norm());
    if (std::isfinite(place.closing_mps + place.sd_m)) in.opponents[in.opponent_count++] = place;
  }
  if (std::isfinite(world.keeper_x_m) && world.keeper_sd_m > 0.0)
    in.keeper = kicking::KeeperPlace{world.keeper_x_m, world.keeper_sd_m};
  return in;
}

msg::KickDecision decision_message(const msg::WorldState& world, const msg::KickerStatus* kicker,
                                   kicking::PolicyName policy, const kicking::PolicyOutput& output) {
  msg::KickDecision out{};
  out.t_ns = world.t_ns;
  out.half = world.half;
  out.possession_id = world.possession_id;
  out.policy = to_wire(policy);
  if (from_outside(policy)) std::strncpy(out.own_policy, name(policy), sizeof out.own_policy - 1);
  copy_fields(output, out);
  out.x_m = world.x_m;
  out.y_m = world.y_m;
  out.heading_rad = world.heading_rad;
  out.vx_mps = world.vx_mps;
  out.vy_mps = world.vy_mps;
  out.omega_radps = world.omega_radps;
  out.assignment_probability = 1.0;
  out.opponent_distance_m = world.opponent_distance_m;
  out.charge = kicker != nullptr ? kicker->charge : 0.0;
  return out;
}

msg::ShadowDecision shadow_message(kicking::PolicyName policy, const kicking::PolicyOutput& output) {
  msg::ShadowDecision out{};
  out.policy = to_wire(policy);
  copy_fields(output, out);
  return out;
}

}  // namespace trivela::robot
