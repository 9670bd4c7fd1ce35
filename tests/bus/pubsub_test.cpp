#include <gmock/gmock.h>

#include <future>
#include <stdexcept>

#include "bus/domain/cyclone.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <Message T>
T sample(std::uint8_t robot_id, std::int64_t t_ns) {
  T message{};
  message.robot_id = robot_id;
  message.t_ns = t_ns;
  return message;
}

template <Message T>
std::vector<std::int64_t> take_times(Reader<T>& reader) {
  std::vector<std::int64_t> times;
  reader.take([&](const T& message) { times.push_back(message.t_ns); });
  return times;
}

TEST(PubSub, ASampleArrivesAsItWasWritten) {
  const Participant participant(fresh_domain());
  Writer<msg::KickDecision> writer(participant);
  Reader<msg::KickDecision> reader(participant);
  auto decision = sample<msg::KickDecision>(5, 40'000'000);
  decision.kick_id = 0x0001'05'0000000002;
  decision.reason = msg::REASON_TURNING;
  decision.distance_m = 7.25;
  decision.shadow_count = 2;
  decision.shadows[1].v_kick_mps = 9.5;
  writer.write(decision);
  const auto n = reader.take([&](const msg::KickDecision& got, const SampleInfo& info) {
    EXPECT_EQ(got.robot_id, 5);
    EXPECT_EQ(got.t_ns, decision.t_ns);
    EXPECT_EQ(got.kick_id, decision.kick_id);
    EXPECT_EQ(got.reason, msg::REASON_TURNING);
    EXPECT_EQ(got.distance_m, 7.25);
    EXPECT_EQ(got.shadows[1].v_kick_mps, 9.5);
    EXPECT_GT(info.source_t_ns, 0);
    EXPECT_NE(info.writer, 0u);
  });
  EXPECT_EQ(n, 1u);
  EXPECT_THAT(take_times(reader), ElementsAre());
}

TEST(PubSub, TopicsWithASlashWork) {
  const Participant participant(fresh_domain());
  Writer<msg::DeviceWheels> writer(participant);
  Reader<msg::DeviceWheels> reader(participant);
  writer.write(sample<msg::DeviceWheels>(1, 20));
  EXPECT_THAT(take_times(reader), ElementsAre(20));
}

TEST(PubSub, AStateReaderSeesTheLastSampleOfEachRobot) {
  const Participant participant(fresh_domain());
  Writer<msg::Odometry> writer(participant);
  Reader<msg::Odometry> reader(participant);
  for (int t = 1; t <= 3; ++t) writer.write(sample<msg::Odometry>(1, t));
  writer.write(sample<msg::Odometry>(2, 4));
  EXPECT_THAT(take_times(reader), ::testing::UnorderedElementsAre(3, 4));
}

TEST(PubSub, AnEventReaderKeepsFiftyARecorderAll) {
  const Participant participant(fresh_domain());
  Writer<msg::KickReceipt> writer(participant);
  Reader<msg::KickReceipt> reader(participant);
  Reader<msg::KickReceipt> recorder(participant, {.keep_all = true});
  for (int t = 1; t <= 300; ++t) writer.write(sample<msg::KickReceipt>(1, t));
  const auto last = take_times(reader);
  ASSERT_EQ(last.size(), 50u);
  EXPECT_EQ(last.front(), 251);
  const auto all = take_times(recorder);
  ASSERT_EQ(all.size(), 300u);
  EXPECT_EQ(all.front(), 1);
  EXPECT_EQ(all.back(), 300);
}

TEST(PubSub, ALateJoinerGetsTheState) {
  const Participant participant(fresh_domain());
  Writer<msg::Referee> writer(participant);
  writer.write(sample<msg::Referee>(1, 10));
  writer.write(sample<msg::Referee>(1, 20));
  Reader<msg::Referee> reader(participant);
  ASSERT_TRUE(reader.wait(seconds(5)));
  EXPECT_THAT(take_times(reader), ElementsAre(20));
}

TEST(PubSub, ALateJoinerGetsNoOldOrder) {
  const Participant participant(fresh_domain());
  Writer<msg::KickOrder> writer(participant);
  writer.write(sample<msg::KickOrder>(1, 10));
  Reader<msg::KickOrder> reader(participant);
  ASSERT_TRUE(reader.wait_for_writers(1, seconds(5)));
  writer.write(sample<msg::KickOrder>(1, 20));
  EXPECT_THAT(take_times(reader), ElementsAre(20));
}

TEST(PubSub, ALateJoinerGetsTheStateOverTheWire) {
  const auto wire = fresh_wire_pair();
  Writer<msg::Referee> writer{Participant(wire.a)};
  writer.write(sample<msg::Referee>(1, 20));
  Reader<msg::Referee> reader{Participant(wire.b)};
  ASSERT_TRUE(reader.wait(seconds(10)));
  EXPECT_THAT(take_times(reader), ElementsAre(20));
}

TEST(PubSub, EventsCrossTheWireInOrderWithoutLoss) {
  const auto wire = fresh_wire_pair();
  Writer<msg::KickReceipt> writer{Participant(wire.a)};
  Reader<msg::KickReceipt> reader(Participant(wire.b), {.keep_all = true});
  ASSERT_TRUE(writer.wait_for_readers(1, seconds(10)));
  ASSERT_TRUE(reader.wait_for_writers(1, seconds(10)));
  std::vector<std::int64_t> expected, got;
  for (int t = 1; t <= 50; ++t) {  // as many as the writer can repeat
    writer.write(sample<msg::KickReceipt>(1, t));
    expected.push_back(t);
  }
  while (got.size() < expected.size() && reader.wait(seconds(10)))
    reader.take([&](const msg::KickReceipt& receipt) { got.push_back(receipt.t_ns); });
  EXPECT_EQ(got, expected);
}

// The air of this test loses a fifth of all packets, and the writer is too fast to repeat all of it from its fifty.
TEST(PubSub, AWriterTooFastForTheAirDropsTheOldestNeverTheNewestAndLeavesGaps) {
  auto wire = fresh_wire_pair();
  const std::string lossy = "<Internal><Test><XmitLossiness>200</XmitLossiness></Test></Internal></Domain>";
  wire.a.xml.replace(wire.a.xml.find("</Domain>"), std::string("</Domain>").size(), lossy);
  Writer<msg::KickReceipt> writer{Participant(wire.a)};
  Reader<msg::KickReceipt> reader(Participant(wire.b), {.keep_all = true});
  ASSERT_TRUE(writer.wait_for_readers(1, seconds(10)));
  ASSERT_TRUE(reader.wait_for_writers(1, seconds(10)));
  constexpr std::int64_t kSamples = 5000;
  for (std::int64_t t = 1; t <= kSamples; ++t) writer.write(sample<msg::KickReceipt>(1, t));
  std::int64_t last = 0, got = 0, gaps = 0;
  while (last < kSamples && reader.wait(seconds(10))) {
    reader.take([&](const msg::KickReceipt& receipt) {
      ASSERT_GT(receipt.t_ns, last);
      gaps += receipt.t_ns - last - 1;
      last = receipt.t_ns;
      ++got;
    });
  }
  EXPECT_EQ(last, kSamples);
  EXPECT_GT(gaps, 0);
  EXPECT_EQ(got + gaps, kSamples);
}

TEST(PubSub, WaitingForAReaderThatNeverComesTimesOut) {
  const Participant participant(fresh_domain());
  const Writer<msg::Odometry> writer(participant);
  EXPECT_FALSE(writer.wait_for_readers(1, milliseconds(20)));
  Reader<msg::Odometry> reader(participant);
  EXPECT_TRUE(writer.wait_for_readers(1, seconds(5)));
  EXPECT_EQ(writer.readers(), 1u);
  EXPECT_FALSE(reader.wait(milliseconds(20)));
}

TEST(PubSub, AMissedDeadlineIsCounted) {
  const Participant participant(fresh_domain());
  const WriterOptions promise{.period = milliseconds(5)};
  Writer<msg::Odometry> writer(participant, promise);
  Reader<msg::Odometry> reader(participant, {.period = milliseconds(5)});
  writer.write(sample<msg::Odometry>(1, 1));
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  take_times(reader);
  while (reader.counts().deadline_missed == 0 && std::chrono::steady_clock::now() < end) reader.wait(milliseconds(20));
  EXPECT_GE(reader.counts().deadline_missed, 1u);
}

TEST(PubSub, AnExceptionInTakePassesThroughAndTheReaderGoesOn) {
  const Participant participant(fresh_domain());
  Writer<msg::Odometry> writer(participant);
  Reader<msg::Odometry> reader(participant);
  writer.write(sample<msg::Odometry>(1, 1));
  EXPECT_THROW(reader.take([](const msg::Odometry&) { throw std::runtime_error("no"); }), std::runtime_error);
  writer.write(sample<msg::Odometry>(1, 2));
  EXPECT_THAT(take_times(reader), ElementsAre(2));
}

TEST(PubSub, ARefusalNamesTheCallTheDomainAndCyclonesText) {
  try {
    const Participant participant(DomainConfig{7, "<CycloneDDS><Nonsense/></CycloneDDS>"});
    FAIL() << "took a configuration that is none";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("dds_create_domain (domain 7): "));
  }
}

TEST(PubSub, OneProcessCannotBeInADomainWithTwoConfigurations) {
  const auto config = fresh_domain();
  const Participant first(config);
  const Participant same(config);
  EXPECT_THROW(Participant(loopback(config.domain_id, "another")), Error);
}

TEST(PubSub, ADomainCanBeJoinedAgainAfterItWasLeft) {
  const auto config = fresh_domain();
  for (int round = 0; round < 3; ++round) {
    const Participant participant(config);
    Writer<msg::Odometry> writer(participant);
    Reader<msg::Odometry> reader(participant);
    writer.write(sample<msg::Odometry>(1, round));
    EXPECT_THAT(take_times(reader), ElementsAre(round));
  }
}

TEST(PubSub, ReadersAndWritersKeepTheirParticipantAlive) {
  Writer<msg::Odometry> writer{Participant(fresh_domain())};
  EXPECT_NO_THROW(writer.write(sample<msg::Odometry>(1, 1)));
}

TEST(PubSub, ASecondWriterOfTheSameOwnerIsNoticed) {
  const auto wire = fresh_wire_pair();
  const Participant here(wire.a), there(wire.b);
  const Writer<msg::KickerStatus> driver(here, {.owner = "kicker_driver/1"});
  const Writer<msg::KickerStatus> other_robot(there, {.owner = "kicker_driver/2"});
  EXPECT_FALSE(driver.other_writer_exists(milliseconds(50)));
  const Writer<msg::KickerStatus> second(there, {.owner = "kicker_driver/1"});
  EXPECT_TRUE(driver.other_writer_exists(seconds(10)));
  EXPECT_TRUE(second.other_writer_exists(seconds(10)));
  EXPECT_TRUE(driver.other_writer_exists(milliseconds(0))) << "who is known is seen at a glance";
}

TEST(PubSub, OfTwoWritersThatBeginTogetherTheElderSeesNoElder) {
  const auto wire = fresh_wire_pair();
  const Participant here(wire.a), there(wire.b);
  const Writer<msg::KickerStatus> elder(here, {.owner = "kicker_driver/1"});
  const Writer<msg::KickerStatus> younger(there, {.owner = "kicker_driver/1"});
  EXPECT_TRUE(younger.elder_writer_exists());
  EXPECT_TRUE(elder.other_writer_exists());
  EXPECT_FALSE(elder.elder_writer_exists());
}

TEST(PubSub, AWriterThatIsLeavingIsNoSecondOne) {
  const auto wire = fresh_wire_pair();
  const Participant here(wire.a), there(wire.b);
  const Writer<msg::KickerStatus> driver(here, {.owner = "kicker_driver/1"});
  auto found = std::async(std::launch::async, [&] { return driver.other_writer_exists(milliseconds(300)); });
  while (found.wait_for(milliseconds(0)) != std::future_status::ready)
    const Writer<msg::KickerStatus> leaving(there, {.owner = "kicker_driver/1"});
  EXPECT_FALSE(found.get());
}

}  // namespace
}  // namespace trivela::bus
