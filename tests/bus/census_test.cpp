// Who is in a domain, and that who looks on is not counted.
#include "bus/census.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::IsEmpty;

ReaderOptions looking_on() {
  ReaderOptions options;
  options.observer = true;
  options.keep_all = true;
  return options;
}

/// Looks until `met`; the last census.
Census census_when(CensusTaker& taker, const std::function<bool(const Census&)>& met) {
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  Census census = taker.take();
  while (!met(census) && std::chrono::steady_clock::now() < end)
    if (taker.wait(seconds(1))) census = taker.take();
  return census;
}

TEST(Observer, IsNotCountedAmongTheReadersThatAWriterWaitsFor) {
  const WirePair wire = fresh_wire_pair();
  const Participant nodes(wire.a), outside(wire.b);
  Writer<msg::Odometry> writer(nodes);
  Reader<msg::Odometry> remote(outside, looking_on());
  Reader<msg::Odometry> local(nodes, looking_on());
  ASSERT_TRUE(remote.wait_for_writers(1, seconds(10)));
  EXPECT_FALSE(writer.wait_for_readers(1, milliseconds(50)));
  EXPECT_EQ(writer.readers(), 0u);
  Reader<msg::Odometry> node(outside);
  EXPECT_TRUE(writer.wait_for_readers(1, seconds(10)));
  EXPECT_FALSE(writer.wait_for_readers(2, milliseconds(50)));
  EXPECT_EQ(writer.readers(), 1u);
}

TEST(Observer, HearsEveryProfile) {
  const WirePair wire = fresh_wire_pair();
  const Participant nodes(wire.a), outside(wire.b);
  WriterOptions with_deadline;
  with_deadline.period = milliseconds(20);
  Writer<msg::Odometry> state(nodes, with_deadline);
  Writer<msg::KickOrder> order(nodes);
  Writer<msg::KickDecision> event(nodes);
  Reader<msg::Odometry> hears_state(outside, looking_on());
  Reader<msg::KickOrder> hears_order(outside, looking_on());
  Reader<msg::KickDecision> hears_event(outside, looking_on());
  const auto receives = [](auto& reader, auto& writer, auto sample) {
    EXPECT_TRUE(reader.wait_for_writers(1, seconds(10)));
    std::size_t received = 0;
    sample.robot_id = 1;
    // Best effort: what is written before the writer knows of the reader, nobody says again.
    for (int i = 0; i < 500 && received == 0; ++i) {
      writer.write(sample);
      if (reader.wait(milliseconds(20))) received = reader.take([](const auto&) {});
    }
    EXPECT_GT(received, 0u) << reader.topic();
    EXPECT_EQ(reader.counts().incompatible, 0u) << reader.topic();
  };
  receives(hears_state, state, msg::Odometry{});
  receives(hears_order, order, msg::KickOrder{});
  receives(hears_event, event, msg::KickDecision{});
}

TEST(Observer, IsGivenTheLastStateWhereItAsksForItAndStaysUncounted) {
  const WirePair wire = fresh_wire_pair();
  const Participant nodes(wire.a), outside(wire.b);
  Writer<msg::DeviceEmulated> writer(nodes);
  msg::DeviceEmulated word{};
  word.robot_id = 1;
  writer.write(word);
  ReaderOptions options = looking_on();
  options.with_the_last = true;
  Reader<msg::DeviceEmulated> late(outside, options);
  ASSERT_TRUE(late.wait(seconds(10)));
  EXPECT_EQ(late.take([](const auto&) {}), 1u);
  EXPECT_EQ(writer.readers(), 0u);
}

TEST(Census, NamesWritersWithOwnerStrengthAndProcess) {
  const WirePair wire = fresh_wire_pair();
  const Participant nodes(wire.a), outside(wire.b);
  CensusTaker taker(outside);
  WriterOptions options;
  options.owner = "kick_decision/1";
  options.strength = 7;
  const Writer<msg::KickOrder> writer(nodes, options);
  const Reader<msg::KickOrder> reader(nodes);
  const Reader<msg::KickOrder> observer(nodes, looking_on());
  const Census census = census_when(
      taker, [](const Census& c) { return c.members.size() == 1 && c.writers.size() == 1 && c.readers.size() == 2; });
  ASSERT_EQ(census.writers.size(), 1u);
  EXPECT_EQ(census.writers[0].topic, "kick_order");
  EXPECT_EQ(census.writers[0].owner, "kick_decision/1");
  EXPECT_EQ(census.writers[0].strength, 7);
  EXPECT_EQ(census.writers[0].member.pid, getpid());
  EXPECT_FALSE(census.writers[0].member.process.empty());
  EXPECT_EQ(std::ranges::count_if(census.readers, [](const End& end) { return end.observer; }), 1);
}

TEST(Census, LeavesItselfOutAndForgetsWhoLeft) {
  const WirePair wire = fresh_wire_pair();
  const Participant outside(wire.b);
  CensusTaker taker(outside);
  const Reader<msg::Odometry> own(outside, looking_on());
  {
    const Participant nodes(wire.a);
    const Writer<msg::Odometry> writer(nodes);
    EXPECT_EQ(census_when(taker, [](const Census& c) { return !c.writers.empty(); }).writers.size(), 1u);
  }
  const Census census = census_when(taker, [](const Census& c) { return c.writers.empty() && c.members.empty(); });
  EXPECT_THAT(census.writers, IsEmpty());
  EXPECT_THAT(census.readers, IsEmpty());
  EXPECT_THAT(census.members, IsEmpty());
}

}  // namespace
}  // namespace trivela::bus
