#include "robot/driver/kicker_machine.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {

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
