#include "hal/cia402/drive_state.hpp"

#include <array>

namespace trivela::hal::cia402 {
namespace {

struct Row {
  DriveState state;
  std::uint16_t mask;
  std::uint16_t value;
  std::string_view name;
};
constexpr std::array<Row, 8> kRows{{{DriveState::kNotReady, 0x4F, 0x00, "not ready to switch on"},
                                    {DriveState::kSwitchOnDisabled, 0x4F, 0x40, "switch on disabled"},
                                    {DriveState::kReady, 0x6F, 0x21, "ready to switch on"},
                                    {DriveState::kSwitchedOn, 0x6F, 0x23, "switched on"},
                                    {DriveState::kEnabled, 0x6F, 0x27, "operation enabled"},
                                    {DriveState::kQuickStop, 0x6F, 0x07, "quick stop active"},
                                    {DriveState::kFaultReaction, 0x4F, 0x0F, "fault reaction active"},
                                    {DriveState::kFault, 0x4F, 0x08, "fault"}}};

}  // namespace

DriveState state_of(std::uint16_t statusword) {
  for (const Row& row : kRows) {
    if ((statusword & row.mask) == row.value) return row.state;
  }
  return DriveState::kUnknown;
}

std::uint16_t statusword_of(DriveState state) {
  for (const Row& row : kRows) {
    if (row.state == state) return row.value;
  }
  return 0;
}

std::string_view name(DriveState state) {
  for (const Row& row : kRows) {
    if (row.state == state) return row.name;
  }
  return "in no known state";
}

std::uint16_t next_controlword(DriveState state, bool reset_faults, std::uint16_t last_controlword) {
  switch (state) {
    case DriveState::kSwitchOnDisabled:
      return kShutdown;
    case DriveState::kReady:
      return kSwitchOn;
    case DriveState::kSwitchedOn:
    case DriveState::kEnabled:
      return kEnableOperation;
    case DriveState::kFault:
      return reset_faults && (last_controlword & kFaultReset) == 0 ? kFaultReset : kDisableVoltage;
    case DriveState::kQuickStop:  // ends in switch on disabled
    case DriveState::kUnknown:    // it may still turn
      return kQuickStopCommand;
    default:
      return kDisableVoltage;
  }
}

}  // namespace trivela::hal::cia402
