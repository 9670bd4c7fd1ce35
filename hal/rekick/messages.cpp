#include "hal/rekick/messages.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::hal::rekick {
namespace {

constexpr double kSupplyUnit_v = 0.0394629;
constexpr std::uint8_t kSupply = 1U << 7, kBooster = 1U << 6, kRelease = 1U << 5, kErrorFlag = 1U << 4;
constexpr std::uint32_t kNormalPriority = 0x40;  // bits 16 to 23
constexpr std::size_t kShortState = 5, kLongState = 6;

std::uint8_t byte(Command command) { return static_cast<std::uint8_t>(command); }
std::uint8_t low(unsigned value) { return static_cast<std::uint8_t>(value & 0xFFU); }
std::uint8_t high(unsigned value) { return static_cast<std::uint8_t>(value >> 8U & 0xFFU); }

}  // namespace

can::Frame ask(Command command) { return can::extended_frame(kBoard, {byte(command)}); }

can::Frame max_voltage(std::uint16_t volts) {
  if (volts <= 0xFF) return can::extended_frame(kBoard, {byte(Command::kMaxVoltage), low(volts)});
  return can::extended_frame(kBoard, {byte(Command::kMaxVoltage), low(volts), high(volts)});
}

can::Frame kick(std::uint16_t pulse_us) {
  return can::extended_frame(kBoard, {byte(Command::kKick), low(pulse_us), high(pulse_us)});
}

std::optional<std::uint16_t> pulse_of(double power, double pulse_us_per_power) {
  const double pulse_us = std::round(power * pulse_us_per_power);
  if (!(pulse_us >= 1.0 && pulse_us <= kLongestPulse_us)) return std::nullopt;
  return static_cast<std::uint16_t>(pulse_us);
}

std::optional<Command> answer_of(const can::Frame& frame) {
  const bool from_it = frame.extended && !frame.error && (frame.id >> 8U & 0xFFU) == kBoard;
  if (!from_it || frame.size == 0) return std::nullopt;
  return static_cast<Command>(frame.data[0]);
}

std::optional<State> state_of(const can::Frame& frame) {
  if (answer_of(frame) != Command::kState || frame.size < kShortState || frame.size > kLongState) return std::nullopt;
  const std::uint8_t flags = frame.data[1];
  const unsigned supply = frame.data[2] + 256U * frame.data[3];
  const unsigned capacitor = frame.data[4] + (frame.size == kLongState ? 256U * frame.data[5] : 0U);
  return State{.supply_on = (flags & kSupply) != 0,
               .booster_on = (flags & kBooster) != 0,
               .release_on = (flags & kRelease) != 0,
               .error = (flags & kErrorFlag) != 0,
               .supply_v = supply * kSupplyUnit_v,
               .capacitor_v = static_cast<double>(capacitor)};
}

can::Frame frame_of(const State& state) {
  const unsigned flags = (state.supply_on ? kSupply : 0U) | (state.booster_on ? kBooster : 0U) |
                         (state.release_on ? kRelease : 0U) | (state.error ? kErrorFlag : 0U);
  const auto supply = static_cast<unsigned>(std::lround(state.supply_v / kSupplyUnit_v));
  const auto capacitor = static_cast<unsigned>(std::lround(state.capacitor_v));
  return from_board({byte(Command::kState), low(flags), low(supply), high(supply), low(capacitor), high(capacitor)});
}

can::Frame from_board(std::initializer_list<std::uint8_t> data) {
  return can::extended_frame(kNormalPriority << 16U | kBoard << 8U, data);
}

can::Frame emulated_pong() { return from_board({byte(Command::kPong), 'p', 'r', 'o', 'g', 'r', 'a', 'm'}); }

bool is_emulated_pong(const can::Frame& frame) {
  return answer_of(frame) == Command::kPong && std::ranges::equal(frame.payload(), emulated_pong().payload());
}

std::string reset_cause(const can::Frame& frame) {
  constexpr const char* kCauses[] = {"power on", "from outside", "brown-out", "watchdog", "JTAG"};
  const bool known = frame.size > 1 && frame.data[1] < std::size(kCauses);
  return known ? kCauses[frame.data[1]] : "unknown cause";
}

}  // namespace trivela::hal::rekick
