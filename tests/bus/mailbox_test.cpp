#include "bus/mailbox.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

msg::VisionFrame frame(std::uint8_t robot_id, std::int64_t t_ns) {
  msg::VisionFrame message{};
  message.robot_id = robot_id;
  message.t_ns = t_ns;
  return message;
}

class MailboxTest : public ::testing::Test {
 protected:
  Participant participant_{fresh_domain()};
  Writer<msg::VisionFrame> writer_{participant_};
};

TEST_F(MailboxTest, IsEmptyUntilASampleArrivesAndThenKeepsTheLatest) {
  Mailbox<msg::VisionFrame> mailbox(participant_);
  EXPECT_FALSE(mailbox.latest());
  writer_.write(frame(1, 20));
  writer_.write(frame(1, 40));
  EXPECT_EQ(mailbox.latest()->t_ns, 40);
  EXPECT_EQ(mailbox.latest()->t_ns, 40) << "looking must not empty it";
}

TEST_F(MailboxTest, SeesOnlyItsRobot) {
  Mailbox<msg::VisionFrame> mailbox(participant_, 2);
  writer_.write(frame(1, 20));
  EXPECT_FALSE(mailbox.latest());
  writer_.write(frame(2, 40));
  writer_.write(frame(1, 60));
  EXPECT_EQ(mailbox.latest()->t_ns, 40);
}

TEST_F(MailboxTest, AwaitTakesWhatIsThere) {
  Mailbox<msg::VisionFrame> mailbox(participant_);
  writer_.write(frame(1, 40));
  EXPECT_EQ(mailbox.await(40, milliseconds(0))->t_ns, 40);
  EXPECT_EQ(mailbox.await(20, milliseconds(0))->t_ns, 40);
}

TEST_F(MailboxTest, AwaitBlocksUntilAnInstantAtOrAfterTheGiven) {
  Mailbox<msg::VisionFrame> mailbox(participant_);
  std::optional<msg::VisionFrame> got;
  std::thread waiting([&] { got = mailbox.await(60, seconds(10)); });
  for (const std::int64_t t : {20, 40, 60}) writer_.write(frame(1, t));
  waiting.join();
  ASSERT_TRUE(got);
  EXPECT_EQ(got->t_ns, 60);
}

TEST_F(MailboxTest, AwaitGivesUpAfterItsTimeout) {
  Mailbox<msg::VisionFrame> mailbox(participant_);
  writer_.write(frame(1, 20));
  EXPECT_FALSE(mailbox.await(40, milliseconds(10)));
}

TEST_F(MailboxTest, AnInterruptEndsAwait) {
  const auto interrupt = std::make_shared<Guard>(participant_);
  Mailbox<msg::VisionFrame> mailbox(participant_, {}, {}, interrupt);
  std::optional<msg::VisionFrame> got = frame(1, 1);
  const auto start = std::chrono::steady_clock::now();
  std::thread waiting([&] { got = mailbox.await(60, seconds(60)); });
  interrupt->set();
  waiting.join();
  EXPECT_FALSE(got);
  EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(30));
}

TEST_F(MailboxTest, InAListenerAwaitRefusesToBlock) {
  Mailbox<msg::VisionFrame> mailbox(participant_);
  const Reaction reaction{"node/topic", "topic", {}};
  const ReactionScope scope(reaction, true);
  EXPECT_THROW(mailbox.await(20, seconds(60)), Error);
  writer_.write(frame(1, 20));
  EXPECT_EQ(mailbox.await(20, seconds(60))->t_ns, 20);
}

}  // namespace
}  // namespace trivela::bus
