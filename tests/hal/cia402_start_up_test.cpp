// The conversation that sets a drive up, without a drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/cia402/start_up.hpp"

namespace trivela::hal::cia402 {
namespace {

using Progress = StartUp::Progress;

constexpr std::uint8_t kNode = 3;
const config::Cia402Device kSettings{.gear = 12.0, .rpm_per_unit = 1.0};

/// Answers that it did what it was asked.
Progress agree(StartUp& start_up) {
  const auto request = sdo_request_of(start_up.request(), kNode);
  if (!request) return start_up.take(heartbeat(kNode, NodeState::kBootUp));
  if (request->write) return start_up.take(sdo_written(kNode, request->object));
  return start_up.take(sdo_value(kNode, request->object, 0x007F00C8, 4));
}

TEST(Cia402StartUp, ResetsThenAsksObjectByObjectUntilTheDriveCanBeStarted) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kYes};
  EXPECT_EQ(start_up.request(), can::standard_frame(0x000, {0x81, 0x03}));
  EXPECT_EQ(start_up.timeout_ns(), 3'000'000'000);
  std::vector<std::uint16_t> asked;
  Progress progress = Progress::kNext;
  while (progress == Progress::kNext && asked.size() < 100) {
    progress = agree(start_up);
    if (const auto request = sdo_request_of(start_up.request(), kNode); request && progress == Progress::kNext)
      asked.push_back(request->object.index);
  }
  EXPECT_EQ(progress, Progress::kDone);
  EXPECT_EQ(asked, (std::vector<std::uint16_t>{0x1016, 0x1016, 0x6007, 0x605A, 0x1017, 0x6060,          //
                                               0x1400, 0x1400, 0x1600, 0x1600, 0x1600, 0x1600, 0x1400,  //
                                               0x1800, 0x1800, 0x1A00, 0x1A00, 0x1A00, 0x1A00, 0x1A00, 0x1800}));
}

TEST(Cia402StartUp, TheFirstObjectIsTheHeartbeatThatTheDriveIsToWatch) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kYes};
  agree(start_up);
  EXPECT_EQ(start_up.request(), can::standard_frame(0x603, {0x23, 0x16, 0x10, 0x01, 0xC8, 0x00, 0x7F, 0x00}));
}

TEST(Cia402StartUp, AnAnswerThatDoesNotComeIsAskedForOnceMore) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kYes};
  agree(start_up);
  const can::Frame request = start_up.request();
  EXPECT_EQ(start_up.timed_out(), Progress::kNext);
  EXPECT_EQ(start_up.request(), request);
  EXPECT_EQ(start_up.timed_out(), Progress::kFailed);
  EXPECT_EQ(start_up.why(), "no answer to object 1016");
}

TEST(Cia402StartUp, AnswersToOthersAndToEarlierQuestionsAreWaitedOver) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kYes};
  EXPECT_EQ(start_up.take(sdo_written(kNode, {0x1016, 1})), Progress::kWaiting) << "it has not come up";
  EXPECT_EQ(start_up.take(heartbeat(kNode, NodeState::kOperational)), Progress::kWaiting);
  agree(start_up);
  EXPECT_EQ(start_up.take(sdo_written(kNode + 1, {0x1016, 1})), Progress::kWaiting);
  EXPECT_EQ(start_up.take(sdo_written(kNode, {0x1017, 0})), Progress::kWaiting);
  EXPECT_EQ(start_up.take(sdo_value(kNode, {0x1016, 1}, 7, 4)), Progress::kWaiting) << "it was to be written";
}

TEST(Cia402StartUp, ADriveThatRestartsMeanwhileIsSetUpFromTheBeginning) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kYes};
  agree(start_up);
  const can::Frame first = start_up.request();
  agree(start_up);
  agree(start_up);
  EXPECT_EQ(start_up.take(heartbeat(kNode, NodeState::kBootUp)), Progress::kNext);
  EXPECT_EQ(start_up.request(), first);
}

TEST(Cia402StartUp, WithoutAResetTheDriveIsMadeQuietAndKeepsItsFaults) {
  StartUp start_up{kNode, kSettings, StartUp::Reset::kNo};
  EXPECT_EQ(start_up.request(), can::standard_frame(0x000, {0x80, 0x03}));
  EXPECT_EQ(start_up.take(heartbeat(kNode, NodeState::kOperational)), Progress::kWaiting);
  EXPECT_EQ(start_up.take(heartbeat(kNode, NodeState::kPreOperational)), Progress::kNext);
  EXPECT_TRUE(sdo_request_of(start_up.request(), kNode));
  StartUp unheard{kNode, kSettings, StartUp::Reset::kNo};
  EXPECT_EQ(unheard.timed_out(), Progress::kNext) << "its heartbeat may be off";
  EXPECT_TRUE(sdo_request_of(unheard.request(), kNode));
}

}  // namespace
}  // namespace trivela::hal::cia402
