#include "bus/renewal.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <future>
#include <mutex>
#include <vector>

#include "bus/domain/qos.hpp"
#include "bus/domain/reader_health.hpp"
#include "bus/executor.hpp"
#include "bus/node.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr seconds kPlenty{30};

msg::VisionFrame frame(std::int64_t t_ns) {
  msg::VisionFrame message{};
  message.robot_id = 1;
  message.t_ns = t_ns;
  return message;
}

template <class T>
std::vector<std::int64_t> taken(Reader<T>& reader) {
  std::vector<std::int64_t> instants;
  reader.take([&](const T& sample) { instants.push_back(sample.t_ns); });
  return instants;
}

/// Waits, with nothing to hear, until the reader has been made again.
bool renewed(AnyReader& reader) {
  const auto deadline = std::chrono::steady_clock::now() + kPlenty;
  while (std::chrono::steady_clock::now() < deadline) {
    if (renew_if_silent(reader)) return true;
    reader.wait(milliseconds{20});
  }
  return false;
}

struct Wire {
  WirePair pair = fresh_wire_pair();
  std::vector<std::string> warnings;
  Participant near{pair.a};
  Participant far{pair.b, {.warn = [this](const std::string& line) { warnings.push_back(line); }, .stay = seconds{0}}};
  Writer<msg::VisionFrame> writer{near};
  Reader<msg::VisionFrame> reader{far};
};

TEST(Renewal, ASilentReaderMadeAnewHearsNothingTwiceAndMissesNothing) {
  Wire wire;
  ASSERT_TRUE(wire.writer.wait_for_readers(1, kPlenty));
  wire.writer.write(frame(1));
  ASSERT_TRUE(wire.reader.wait(kPlenty));
  EXPECT_THAT(taken(wire.reader), ElementsAre(1));
  ASSERT_TRUE(renewed(wire.reader));
  // The writer keeps its last sample for readers that come late; this one has had it.
  ASSERT_TRUE(wire.reader.wait_for_writers(1, kPlenty));
  wire.reader.wait(milliseconds{200});
  EXPECT_THAT(taken(wire.reader), IsEmpty());
  wire.writer.write(frame(2));
  ASSERT_TRUE(wire.reader.wait(kPlenty));
  EXPECT_THAT(taken(wire.reader), ElementsAre(2));
  ASSERT_FALSE(wire.warnings.empty());
  EXPECT_THAT(wire.warnings.front(), testing::HasSubstr("vision: silent for"));
}

TEST(Renewal, EventsThatAreSaidWhileTheirReaderIsMadeAnewAreHeardOnceEach) {
  Wire wire;  // its own reader hears nothing, so that all are made again
  Writer<msg::KickReceipt> events{wire.near};
  Reader<msg::KickReceipt> receives{wire.far, {.period = {}, .keep_all = true, .on_liveliness = {}}};
  ASSERT_TRUE(events.wait_for_readers(1, kPlenty));
  ASSERT_TRUE(renewed(wire.reader));
  std::vector<std::uint64_t> received;
  int renewals = 0;
  for (std::uint64_t seq = 1; seq <= 300; ++seq) {
    msg::KickReceipt event{};
    event.robot_id = 1;
    event.seq = seq;
    events.write(event);
    renewals += renew_if_silent(receives);
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    while (received.size() < seq && std::chrono::steady_clock::now() < deadline) {
      receives.take([&](const msg::KickReceipt& sample) { received.push_back(sample.seq); });
      if (received.size() < seq) receives.wait(milliseconds{1});
    }
    ASSERT_EQ(received.size(), seq);
    ASSERT_EQ(received.back(), seq);
  }
  EXPECT_EQ(renewals, 1);
}

// Of a plain client of Cyclone's.
TEST(Renewal, AWriterWhoseQosDoesNotFitIsCounted) {
  Wire wire;
  const Participant foreign{wire.pair.a};
  const Entity topic{
      dds_create_topic(foreign.handle(), &meta<msg::VisionFrame>::descriptor(), "vision", nullptr, nullptr)};
  const Qos best_effort{dds_create_qos()};
  dds_qset_reliability(best_effort.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  const Entity writer{dds_create_writer(foreign.handle(), topic.handle(), best_effort.get(), nullptr)};
  ASSERT_TRUE(wire.writer.wait_for_readers(1, kPlenty));
  const auto said = [&] {
    return std::ranges::any_of(wire.warnings, [](const std::string& line) {
      return line.find(", 1 turned away since their QoS does not fit: the reader") != std::string::npos;
    });
  };
  for (int times = 0; times < 4 && !said(); ++times) ASSERT_TRUE(renewed(wire.reader));
  EXPECT_TRUE(said());
}

TEST(Renewal, NobodyIsMadeAnewWhereThisIsNoRealTime) {
  const Participant participant{fresh_domain()};
  Reader<msg::VisionFrame> reader{participant};
  EXPECT_FALSE(reader.wait(milliseconds{700}));
  EXPECT_FALSE(renew_if_silent(reader));
}

TEST(Renewal, AReaderThatHearsIsLeftAlone) {
  Wire wire;
  ASSERT_TRUE(wire.writer.wait_for_readers(1, kPlenty));
  const auto until = std::chrono::steady_clock::now() + milliseconds{800};
  for (std::int64_t t_ns = 1; std::chrono::steady_clock::now() < until; ++t_ns) {
    wire.writer.write(frame(t_ns));
    ASSERT_TRUE(wire.reader.wait(kPlenty));
    taken(wire.reader);
    EXPECT_FALSE(renew_if_silent(wire.reader));
  }
}

class RenewalInExecutor : public testing::TestWithParam<Executor::Kind> {};

TEST_P(RenewalInExecutor, AReactionGoesOnAfterItsTopicWasSilent) {
  const WirePair pair = fresh_wire_pair();
  const Participant near{pair.a};
  std::promise<void> silent;
  std::once_flag once;
  const Participant far{
      pair.b,
      {.warn = [&](const std::string&) { std::call_once(once, [&] { silent.set_value(); }); }, .stay = seconds{1000}}};
  Writer<msg::VisionFrame> writer{near};
  Node node{far, "listener", 1};
  std::promise<void> first;
  std::promise<void> second;
  int received = 0;
  node.on<msg::VisionFrame>([&](const msg::VisionFrame&) { (++received == 1 ? first : second).set_value(); });
  Stop stop;
  auto run = std::async(std::launch::async, [&] { Executor{GetParam(), stop, {&node}}.run(); });
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty));
  writer.write(frame(1));
  EXPECT_EQ(first.get_future().wait_for(kPlenty), std::future_status::ready);
  EXPECT_EQ(silent.get_future().wait_for(kPlenty), std::future_status::ready);
  writer.write(frame(2));
  EXPECT_EQ(second.get_future().wait_for(kPlenty), std::future_status::ready);
  stop.request();
  run.get();
}

INSTANTIATE_TEST_SUITE_P(Kinds, RenewalInExecutor, testing::Values(Executor::kListener, Executor::kWaitset));

TEST(Renewal, WhereItDoesNotHelpTheExecutorEndsWithTheTopicsName) {
  const WirePair pair = fresh_wire_pair();
  const Participant near{pair.a};
  const Participant far{pair.b, {.warn = {}, .stay = seconds{0}}};
  const Writer<msg::VisionFrame> says_nothing{near};
  Node node{far, "listener", 1};
  node.on<msg::VisionFrame>([](const msg::VisionFrame&) {});
  Stop stop;
  try {
    Executor{Executor::kListener, stop, {&node}}.run();
    ADD_FAILURE() << "it goes on";
  } catch (const BusUnresponsive& deaf) {
    EXPECT_THAT(deaf.what(), testing::HasSubstr("vision"));
  }
  EXPECT_FALSE(stop.requested()) << "the program may join again";
}

TEST(Renewal, AnInstantMoreThanASecondAheadIsBelievedInRealTimeByNobody) {
  const auto now = std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  const DomainConfig domain = fresh_domain();
  const Participant real_time{domain, RealTime{}};
  EXPECT_TRUE(real_time.believes(now));
  EXPECT_TRUE(real_time.believes(0));
  EXPECT_FALSE(real_time.believes(now + kHour_ns));
  EXPECT_FALSE(real_time.believes(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(real_time.believes(std::numeric_limits<std::int64_t>::min()));
  EXPECT_TRUE(Participant{domain}.believes(now + kHour_ns)) << "a simulated clock knows no now";
}

}  // namespace
}  // namespace trivela::bus
