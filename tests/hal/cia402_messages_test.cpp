// The bytes of CANopen and the states of CiA 402, without a drive.
#include <gtest/gtest.h>

#include "hal/cia402/canopen.hpp"
#include "hal/cia402/drive_state.hpp"
#include "hal/cia402/start_up.hpp"

namespace trivela::hal::cia402 {
namespace {

using can::Frame;
using can::standard_frame;

// The trace of ros-industrial/ros_canopen #259, by candump -td.
TEST(CanOpen, SpeaksAsARecordedDriveDoes) {
  EXPECT_EQ(nmt(Nmt::kPreOperational, 3), standard_frame(0x000, {0x80, 0x03}));
  EXPECT_EQ(static_cast<int>(Nmt::kReset), 0x81);
  EXPECT_EQ(heartbeat_of(standard_frame(0x703, {0x00}), 3), NodeState::kBootUp);
  EXPECT_EQ(sdo_write(3, {0x1017, 0}, 1000, 2),
            standard_frame(0x603, {0x2B, 0x17, 0x10, 0x00, 0xE8, 0x03, 0x00, 0x00}));
  EXPECT_EQ(sdo_read(3, {0x6041, 0}), standard_frame(0x603, {0x40, 0x41, 0x60, 0x00, 0x00, 0x00, 0x00, 0x00}));
  const auto written = sdo_reply_of(standard_frame(0x583, {0x60, 0x17, 0x10, 0x00, 0x00, 0x00, 0x00, 0x00}), 3);
  ASSERT_TRUE(written);
  EXPECT_EQ(written->kind, SdoReply::Kind::kWritten);
  EXPECT_EQ(written->object, (Object{0x1017, 0}));
  const auto status = sdo_reply_of(standard_frame(0x583, {0x4B, 0x41, 0x60, 0x00, 0x18, 0x02, 0x00, 0x00}), 3);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->kind, SdoReply::Kind::kRead);
  EXPECT_EQ(status->value, 0x0218u);
  EXPECT_EQ(state_of(0x0218), DriveState::kFault);
  EXPECT_EQ(emergency_of(standard_frame(0x083, {0xB0, 0x81, 0x01, 0, 0, 0, 0, 0}), 3), 0x81B0);
}

TEST(CanOpen, WritesOfEverySizeAndTheMastersOwnFrames) {
  EXPECT_EQ(sdo_write(1, {0x1016, 1}, 0x007F0064, 4),
            standard_frame(0x601, {0x23, 0x16, 0x10, 0x01, 0x64, 0x00, 0x7F, 0x00}));
  EXPECT_EQ(sdo_write(1, {0x6060, 0}, 3, 1), standard_frame(0x601, {0x2F, 0x60, 0x60, 0x00, 0x03, 0x00, 0x00, 0x00}));
  EXPECT_EQ(heartbeat(127, NodeState::kOperational), standard_frame(0x77F, {0x05}));
  EXPECT_EQ(sync(), standard_frame(0x080, {}));
  EXPECT_EQ(nmt(Nmt::kStart, 4), standard_frame(0x000, {0x01, 0x04}));
}

TEST(CanOpen, PdosAreVelocityAndWordLittleEndian) {
  EXPECT_EQ(rx_pdo(2, -500, kEnableOperation), standard_frame(0x202, {0x0C, 0xFE, 0xFF, 0xFF, 0x0F, 0x00}));
  const auto pdo = tx_pdo_of(standard_frame(0x182, {0x0C, 0xFE, 0xFF, 0xFF, 0x9C, 0xFF, 0x37, 0x02}), 2);
  ASSERT_TRUE(pdo);
  EXPECT_EQ(pdo->velocity, -500);
  EXPECT_EQ(pdo->current_ma, -100);
  EXPECT_EQ(state_of(pdo->statusword), DriveState::kEnabled);
  EXPECT_EQ(frame_of(*pdo, 2), standard_frame(0x182, {0x0C, 0xFE, 0xFF, 0xFF, 0x9C, 0xFF, 0x37, 0x02}));
}

TEST(CanOpen, FramesOfOthersAndBrokenOnesSayNothing) {
  const Frame pdo = standard_frame(0x182, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_FALSE(tx_pdo_of(pdo, 3));
  EXPECT_FALSE(tx_pdo_of(standard_frame(0x182, {1, 2, 3}), 2));
  Frame extended = pdo, error = pdo;
  extended.extended = true;
  error.error = true;
  EXPECT_FALSE(tx_pdo_of(extended, 2));
  EXPECT_FALSE(tx_pdo_of(error, 2));
  EXPECT_FALSE(sdo_reply_of(standard_frame(0x582, {0x60, 0x17, 0x10}), 2));
  EXPECT_FALSE(sdo_reply_of(standard_frame(0x582, {0x41, 0x08, 0x10, 0x00, 0x0A, 0, 0, 0}), 2)) << "of many frames";
  EXPECT_FALSE(heartbeat_of(standard_frame(0x702, {}), 2));
  EXPECT_FALSE(emergency_of(sync(), 0));
}

TEST(CanOpen, SaysAbortsAndEmergenciesInWords) {
  const auto aborted = sdo_reply_of(sdo_abort(2, {0x1016, 1}, kNoSuchObject), 2);
  ASSERT_TRUE(aborted);
  EXPECT_EQ(aborted->kind, SdoReply::Kind::kAborted);
  EXPECT_EQ(abort_words(aborted->value), "no such object (06020000)");
  EXPECT_EQ(abort_words(0x12345678), "it was aborted (12345678)");
  EXPECT_EQ(emergency_words(0x2310), "overcurrent (2310)");
  EXPECT_EQ(emergency_words(0xFF06), "Hall sensor or encoder (FF06)");
  EXPECT_EQ(emergency_words(0x4567), "emergency (4567)");
}

TEST(DriveState, IsReadByItsMaskWhateverTheOtherBitsSay) {
  constexpr std::pair<std::uint16_t, DriveState> kWords[] = {
      {0x0200, DriveState::kNotReady},      {0x0250, DriveState::kSwitchOnDisabled},
      {0x0231, DriveState::kReady},         {0x0233, DriveState::kSwitchedOn},
      {0x1637, DriveState::kEnabled},       {0x0217, DriveState::kQuickStop},
      {0x021F, DriveState::kFaultReaction}, {0x0218, DriveState::kFault},
      {0x0262, DriveState::kUnknown}};
  for (const auto& [word, state] : kWords) EXPECT_EQ(name(state_of(word)), name(state)) << std::hex << word;
  for (int i = 0; i < static_cast<int>(DriveState::kUnknown); ++i)
    EXPECT_EQ(state_of(statusword_of(static_cast<DriveState>(i))), static_cast<DriveState>(i));
}

TEST(DriveState, IsBroughtIntoOperationStepByStep) {
  EXPECT_EQ(next_controlword(DriveState::kNotReady, true, 0), kDisableVoltage);
  EXPECT_EQ(next_controlword(DriveState::kSwitchOnDisabled, true, 0), kShutdown);
  EXPECT_EQ(next_controlword(DriveState::kReady, true, kShutdown), kSwitchOn);
  EXPECT_EQ(next_controlword(DriveState::kSwitchedOn, true, kSwitchOn), kEnableOperation);
  EXPECT_EQ(next_controlword(DriveState::kEnabled, true, kEnableOperation), kEnableOperation);
  EXPECT_EQ(next_controlword(DriveState::kQuickStop, true, kQuickStopCommand), kQuickStopCommand);
  EXPECT_EQ(next_controlword(DriveState::kUnknown, true, 0), kQuickStopCommand) << "it may still turn";
}

TEST(DriveState, AFaultIsResetByARisingEdgeAndOnlyWhereThatIsWanted) {
  EXPECT_EQ(next_controlword(DriveState::kFault, true, kEnableOperation), kFaultReset);
  EXPECT_EQ(next_controlword(DriveState::kFault, true, kFaultReset), kDisableVoltage);
  EXPECT_EQ(next_controlword(DriveState::kFault, false, kDisableVoltage), kDisableVoltage);
  EXPECT_EQ(next_controlword(DriveState::kFaultReaction, true, 0), kDisableVoltage);
}

TEST(VelocityUnit, IsATenthPowerOfRpmOrRefused) {
  EXPECT_EQ(rpm_per_unit_of(0x00B44700), 1.0);
  EXPECT_DOUBLE_EQ(rpm_per_unit_of(0xFFB44700).value(), 0.1);
  EXPECT_DOUBLE_EQ(rpm_per_unit_of(0xFDB44700).value(), 0.001);
  EXPECT_FALSE(rpm_per_unit_of(0x00B54700));
  EXPECT_FALSE(rpm_per_unit_of(0x80B44700));
}

}  // namespace
}  // namespace trivela::hal::cia402
