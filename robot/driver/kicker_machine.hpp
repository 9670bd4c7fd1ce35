#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "hal/kicker.hpp"
#include "idl/messages.hpp"

namespace trivela::robot {

/// What can happen to a kicker, as far as its driver has to do something about it.
enum class KickerEvent {
  kArmed,     ///< switch on, the referee lets play, the decision node is there
  kDisarmed,  ///< switch off, the game stands, or the referee is silent
  kCharged,   ///< the capacitor holds what a kick needs, and the last shot is over and rested
  kUncharged,
  kAccepted,      ///< an order was accepted, its instant may lie ahead
  kCalledOff,     ///< it is not carried out after all
  kShotOver,      ///< its instant and its pulse have passed
  kRested,        ///< the least interval after a shot has passed
  kFault,         ///< of the device or its charger, or no status comes any more
  kOverVoltage,   ///< more than the capacitor may hold was measured
  kHealthy,       ///< no fault is left
  kDecisionLost,  ///< the decision node has been gone for 0.2 s
  kEnd,           ///< this program ends
};
inline constexpr std::array kKickerEvents{KickerEvent::kArmed,       KickerEvent::kDisarmed, KickerEvent::kCharged,
                                          KickerEvent::kUncharged,   KickerEvent::kAccepted, KickerEvent::kCalledOff,
                                          KickerEvent::kShotOver,    KickerEvent::kRested,   KickerEvent::kFault,
                                          KickerEvent::kOverVoltage, KickerEvent::kHealthy,  KickerEvent::kDecisionLost,
                                          KickerEvent::kEnd};

/// What the driver is about, and what it tells a board that can be told.
struct KickerMachineState {
  msg::KickerState state = msg::STATE_OFF;
  hal::ChargeCommand word = hal::ChargeCommand::kHold;
  bool operator==(const KickerMachineState&) const = default;
};

/// The kicker's state machine: where `event` leads from `stand`. It charges in charging, ready, firing and cooling, and
/// in no other state; what empties the capacitor is undone by kArmed alone. docs/kicker.md has the table.
constexpr KickerMachineState next(KickerMachineState stand, KickerEvent event) {
  using enum hal::ChargeCommand;
  constexpr KickerMachineState kCharging{msg::STATE_CHARGING, kCharge};
  const bool fault = stand.state == msg::STATE_FAULT;
  switch (event) {  // what counts in every state
    case KickerEvent::kFault:
      return fault ? stand : KickerMachineState{msg::STATE_FAULT, kHold};
    case KickerEvent::kOverVoltage:
      return {msg::STATE_FAULT, kDischarge};
    case KickerEvent::kDecisionLost:
    case KickerEvent::kEnd:
      return {fault ? msg::STATE_FAULT : msg::STATE_OFF, kDischarge};
    case KickerEvent::kDisarmed:
      return fault || stand.state == msg::STATE_OFF ? stand : KickerMachineState{msg::STATE_OFF, kHold};
    default:
      break;
  }
  switch (stand.state) {
    case msg::STATE_OFF:
      return event == KickerEvent::kArmed ? kCharging : stand;
    case msg::STATE_CHARGING:
      return event == KickerEvent::kCharged ? KickerMachineState{msg::STATE_READY, kCharge} : stand;
    case msg::STATE_READY:
      if (event == KickerEvent::kAccepted) return {msg::STATE_FIRING, kCharge};
      return event == KickerEvent::kUncharged ? kCharging : stand;
    case msg::STATE_FIRING:
      if (event == KickerEvent::kCalledOff) return kCharging;
      return event == KickerEvent::kShotOver ? KickerMachineState{msg::STATE_COOLING, kCharge} : stand;
    case msg::STATE_COOLING:
      return event == KickerEvent::kRested ? kCharging : stand;
    case msg::STATE_FAULT:
      return event == KickerEvent::kHealthy ? KickerMachineState{msg::STATE_OFF, stand.word} : stand;
  }
  return stand;
}

/// Whether the capacitor's voltage rises while it is charged. One that does not has a charger, a coil or a wire that is
/// broken, and goes on being heated. A device that measures no voltage is never doubted.
class VoltageWatch {
 public:
  /// `rise_v` within `within_s`, or it does not rise.
  VoltageWatch(double rise_v, double within_s) : rise_v_(rise_v), within_s_(within_s) {}

  /// A sample, and whether the board was told to charge. True: it does not rise, until the arm switch is opened.
  bool stuck(const hal::KickerSample& sample, bool charging);

 private:
  double rise_v_;
  double within_s_;
  struct Mark {
    std::int64_t t_ns;
    double voltage_v;
  };
  std::optional<Mark> mark_;  // since when it has not risen
  bool stuck_ = false;
};

/// The capabilities that are demanded and that the device does not have, as the settings name them; empty: none.
std::string missing(const std::vector<config::Capability>& demanded, const hal::KickerCapabilities& there);

/// A device that measures its capacitor finds more in it than it may hold: a charge above kMostCharge.
bool over_voltage(const hal::KickerSample& sample);
inline constexpr double kMostCharge = 1.05;

}  // namespace trivela::robot
