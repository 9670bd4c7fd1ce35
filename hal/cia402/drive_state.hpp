#pragma once

#include <cstdint>
#include <string_view>

/// The state machine of CiA 402. Source of the masks: canopen-python/canopen, canopen/profiles/p402.py.
namespace trivela::hal::cia402 {

enum class DriveState {
  kNotReady,
  kSwitchOnDisabled,
  kReady,
  kSwitchedOn,
  kEnabled,
  kQuickStop,
  kFaultReaction,
  kFault,
  kUnknown,  ///< no state has such a statusword
};

/// What a statusword (6041) says.
DriveState state_of(std::uint16_t statusword);

/// A statusword that says it.
std::uint16_t statusword_of(DriveState state);

/// "operation enabled".
std::string_view name(DriveState state);

inline constexpr std::uint16_t kDisableVoltage = 0x00, kQuickStopCommand = 0x02, kShutdown = 0x06, kSwitchOn = 0x07,
                               kEnableOperation = 0x0F, kFaultReset = 0x80;

/// The controlword (6040) that brings a drive nearer to operation, one state at a time. A fault is left alone unless
/// `reset_faults`: then it is reset, whenever the last controlword makes that a rising edge of its bit.
std::uint16_t next_controlword(DriveState state, bool reset_faults, std::uint16_t last_controlword);

}  // namespace trivela::hal::cia402
