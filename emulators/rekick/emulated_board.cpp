#include "emulators/rekick/emulated_board.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::rekick {
namespace {

constexpr double kBattery_v = 24.0;
constexpr std::int64_t kNsPerUs = 1000;
const can::Frame kForeign = can::extended_frame(0x40A000, {0xF2, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});  // a ball handler

std::uint16_t word_of(const can::Frame& frame) {
  return static_cast<std::uint16_t>(frame.data[1] + (frame.size > 2 ? 256 * frame.data[2] : 0));
}

}  // namespace

double EmulatedBoard::energy(std::int64_t now_ns) const {
  if (measured_energy) return *measured_energy;
  return std::min(1.0, energy_ + kicking::seconds(energy_ns_, now_ns) / kChargeTime_s);
}

double EmulatedBoard::capacitor_v(std::int64_t now_ns) const { return max_voltage_v_ * std::sqrt(energy(now_ns)); }

std::vector<std::string> EmulatedBoard::take(std::string_view bytes, std::int64_t now_ns) {
  std::vector<std::string> said;
  for (const can::Frame& frame : can::decode(bytes)) {
    if (frame.extended && frame.id == kBoard && frame.size > 0) obey(frame, now_ns, said);
  }
  return said;
}

std::vector<std::string> EmulatedBoard::tick(std::int64_t) {
  std::vector<std::string> said;
  for (const can::Frame& frame : std::exchange(to_say_, {})) said.push_back(can::encode(frame));
  return said;
}

void EmulatedBoard::obey(const can::Frame& frame, std::int64_t now_ns, std::vector<std::string>& said) {
  switch (static_cast<Command>(frame.data[0])) {
    case Command::kPing:
      return answer(emulated_pong(), said);
    case Command::kKick:
      return kick(word_of(frame), now_ns);
    case Command::kMaxVoltage:
      ++voltages_told_;
      if (max_voltage_v_ == 0) energy_ns_ = now_ns;
      max_voltage_v_ = word_of(frame);
      return;
    case Command::kGetState:
      ++looks_;
      last_look_ns_ = now_ns;
      return answer(frame_of({.supply_on = supply_on,
                              .booster_on = energy(now_ns) < 1.0,
                              .release_on = now_ns < pulse_ends_ns_,
                              .error = faults.error,
                              .supply_v = kBattery_v,
                              .capacitor_v = capacitor_v(now_ns)}),
                    said);
    default:
      return;
  }
}

void EmulatedBoard::kick(std::uint16_t pulse_us, std::int64_t now_ns) {
  ++kicks_told_;
  if (now_ns < pulse_ends_ns_) return;
  pulses_.push_back({now_ns, pulse_us});
  pulse_ends_ns_ = now_ns + pulse_us * kNsPerUs;
  energy_ = energy(now_ns) * std::max(0.0, 1.0 - pulse_us / kLongestPulse_us);
  energy_ns_ = now_ns;
}

void EmulatedBoard::answer(const can::Frame& frame, std::vector<std::string>& said) {
  ++answers_;
  if (hits(faults.foreign_every)) said.push_back(can::encode(kForeign));
  if (!faults.silent && !hits(faults.lost_every)) said.push_back(can::encode(frame));
}

}  // namespace trivela::hal::rekick
