#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/can/can_line.hpp"

/// What the ReKick board says and is told over CAN, in frames with 29-bit identifiers: to it with its own number, from
/// it with that number in bits 8 to 15. The first byte is the command. Source: dasys-lab/cnc-msldriver,
/// msl_kick_control/{include/Kicker.h,src/Kicker.cpp}, can_connection/include/Can.h, usb_can_proxy/src/UsbCanProxy.cpp;
/// the firmware is not public.
namespace trivela::hal::rekick {

inline constexpr std::uint32_t kBoard = 0x60;

enum class Command : std::uint8_t {
  kPing = 0x01,
  kKick = 0x03,        ///< pulse in us, low byte, high byte
  kMaxVoltage = 0x31,  ///< volts to charge to: a byte, or low byte, high byte
  kGetState = 0x40,
  kPong = 0xF1,
  kState = 0xF2,
  kReset = 0xF4,  ///< cause
  kError = 0x21,  ///< text
  kWarning = 0x22,
  kText = 0x3E,
};

inline constexpr double kLongestPulse_us = 3499.0;

/// What the board answers to kGetState.
struct State {
  bool supply_on = false;
  bool booster_on = false;  ///< it charges
  bool release_on = false;  ///< the coil is energised
  bool error = false;
  double supply_v = 0.0;
  double capacitor_v = 0.0;
};

can::Frame ask(Command command);
can::Frame max_voltage(std::uint16_t volts);
can::Frame kick(std::uint16_t pulse_us);

/// The pulse of a set-point: power pulse_us_per_power, rounded [us]. None: not within 1 to kLongestPulse_us.
std::optional<std::uint16_t> pulse_of(double power, double pulse_us_per_power);

/// The command of a frame that the board sent; none: it is somebody else's, or empty.
std::optional<Command> answer_of(const can::Frame& frame);

/// None: it is no state, or too short for one.
std::optional<State> state_of(const can::Frame& frame);

/// The state as the board says it.
can::Frame frame_of(const State& state);

/// A frame that the board sends.
can::Frame from_board(std::initializer_list<std::uint8_t> data);

/// The emulated board's answer to kPing, which says what it is; a board's own has no text.
can::Frame emulated_pong();
bool is_emulated_pong(const can::Frame& frame);

/// Why the board was reset: "brown-out".
std::string reset_cause(const can::Frame& frame);

}  // namespace trivela::hal::rekick
