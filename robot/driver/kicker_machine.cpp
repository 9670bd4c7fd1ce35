#include "robot/driver/kicker_machine.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

using hal::ChargeWord;

constexpr KickerStand kOff{msg::STATE_OFF, ChargeWord::kHold};
constexpr KickerStand kCharging{msg::STATE_CHARGING, ChargeWord::kUp};
constexpr KickerStand kReady{msg::STATE_READY, ChargeWord::kUp};
constexpr KickerStand kFiring{msg::STATE_FIRING, ChargeWord::kUp};
constexpr KickerStand kCooling{msg::STATE_COOLING, ChargeWord::kUp};
constexpr KickerStand kEmptied{msg::STATE_OFF, ChargeWord::kEmpty};

/// What counts in every state; none: the state decides.
std::optional<KickerStand> anywhere(KickerStand stand, KickerEvent event) {
  const bool fault = stand.state == msg::STATE_FAULT;
  switch (event) {
    case KickerEvent::kFault:
      return fault ? stand : KickerStand{msg::STATE_FAULT, ChargeWord::kHold};
    case KickerEvent::kOverVoltage:
      return KickerStand{msg::STATE_FAULT, ChargeWord::kEmpty};
    case KickerEvent::kDecisionLost:
    case KickerEvent::kEnd:
      return fault ? KickerStand{msg::STATE_FAULT, ChargeWord::kEmpty} : kEmptied;
    default:
      return std::nullopt;
  }
}

bool is_armed(msg::KickerState state) { return state != msg::STATE_OFF && state != msg::STATE_FAULT; }

}  // namespace

KickerStand next(KickerStand stand, KickerEvent event) {
  if (const auto to = anywhere(stand, event)) return *to;
  if (is_armed(stand.state) && event == KickerEvent::kDisarmed) return kOff;
  switch (stand.state) {
    case msg::STATE_OFF:
      return event == KickerEvent::kArmed ? kCharging : stand;
    case msg::STATE_CHARGING:
      return event == KickerEvent::kCharged ? kReady : stand;
    case msg::STATE_READY:
      if (event == KickerEvent::kAccepted) return kFiring;
      return event == KickerEvent::kUncharged ? kCharging : stand;
    case msg::STATE_FIRING:
      if (event == KickerEvent::kCalledOff) return kCharging;
      return event == KickerEvent::kShotOver ? kCooling : stand;
    case msg::STATE_COOLING:
      return event == KickerEvent::kRested ? kCharging : stand;
    case msg::STATE_FAULT:
      return event == KickerEvent::kSound ? KickerStand{msg::STATE_OFF, stand.word} : stand;
  }
  return stand;
}

bool VoltageWatch::stuck(const hal::KickerSample& sample, bool charging) {
  if (!sample.armed) stuck_ = false;
  if (!charging || !sample.voltage_v) {
    mark_.reset();
    return stuck_;
  }
  if (!mark_ || *sample.voltage_v >= mark_->voltage_v + rise_v_) mark_ = Mark{sample.t_ns, *sample.voltage_v};
  if (kicking::seconds(mark_->t_ns, sample.t_ns) > within_s_) stuck_ = true;
  return stuck_;
}

std::string missing(const std::vector<config::Capability>& demanded, const hal::KickerCapabilities& there) {
  const auto lacks = [&](config::Capability wanted, bool has, const char* name) {
    return !has && std::ranges::find(demanded, wanted) != demanded.end() ? std::string(", ") + name : std::string();
  };
  const std::string all = lacks(config::Capability::kChargeControl, there.charge_control, "charge_control") +
                          lacks(config::Capability::kVoltage, there.voltage, "voltage") +
                          lacks(config::Capability::kDischarge, there.discharge, "discharge") +
                          lacks(config::Capability::kWatchdog, there.watchdog, "watchdog");
  return all.empty() ? all : all.substr(2);
}

bool over_voltage(const hal::KickerSample& sample) {
  return sample.voltage_v && !sample.charge_modelled && sample.charge > kMostCharge;
}

}  // namespace trivela::robot
