#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Hears of the writers of an order topic.
class Watch {
 public:
  ReaderOptions options() {
    ReaderOptions options;
    options.on_liveliness = [this](const Liveliness& now) {
      const std::lock_guard lock(mutex_);
      now_ = now;
      changed_.notify_all();
    };
    return options;
  }
  bool wait(std::uint32_t alive, std::uint32_t lapsed) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, seconds(10), [&] { return now_.alive == alive && now_.lapsed == lapsed; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Liveliness now_;
};

msg::KickOrder order(std::int64_t kick_id) {
  msg::KickOrder message{};
  message.robot_id = 1;
  message.kick_id = kick_id;
  return message;
}

TEST(Liveliness, ADecisionLoopThatHangsIsReportedAndItsNextOrderRevivesIt) {
  const auto wire = fresh_wire_pair();
  Writer<msg::KickOrder> writer(Participant(wire.a), {.lease = milliseconds(50)});
  Watch watch;
  const Reader<msg::KickOrder> reader(Participant(wire.b), watch.options());
  ASSERT_TRUE(writer.wait_for_readers(1, seconds(10)));
  writer.write(order(1));
  ASSERT_TRUE(watch.wait(1, 0));
  EXPECT_TRUE(watch.wait(0, 1)) << "silence was not noticed";
  EXPECT_EQ(reader.liveliness().lapsed, 1u);
  writer.write(order(2));
  EXPECT_TRUE(watch.wait(1, 0)) << "an order did not bring the writer back";
}

TEST(Liveliness, AWriterThatGoesAwayIsReported) {
  const Participant participant(fresh_domain());
  Watch watch;
  const Reader<msg::KickOrder> reader(participant, watch.options());
  {
    Writer<msg::KickOrder> writer(participant, {.lease = seconds(10)});
    writer.write(order(1));
    ASSERT_TRUE(watch.wait(1, 0));
  }
  EXPECT_TRUE(watch.wait(0, 0));
}

TEST(Liveliness, OfTwoWritersTheStrongerIsHeardUntilItLapses) {
  const Participant participant(fresh_domain());
  Writer<msg::KickOrder> chief(participant, {.lease = milliseconds(50), .strength = 2});
  Writer<msg::KickOrder> standby(participant, {.lease = seconds(10), .strength = 1});
  Watch watch;
  Reader<msg::KickOrder> reader(participant, watch.options());
  const auto received = [&] {
    std::vector<std::int64_t> ids;
    reader.take([&](const msg::KickOrder& o) { ids.push_back(o.kick_id); });
    return ids;
  };
  chief.write(order(1));
  standby.write(order(2));
  EXPECT_EQ(received(), std::vector<std::int64_t>{1});
  ASSERT_TRUE(watch.wait(1, 1)) << "the chief never lapsed";
  standby.write(order(3));
  EXPECT_EQ(received(), std::vector<std::int64_t>{3});
}

TEST(Liveliness, AssertingItHoldsTheLease) {
  const Participant participant(fresh_domain());
  Writer<msg::KickOrder> writer(participant, {.lease = milliseconds(400)});
  Reader<msg::KickOrder> reader(participant);
  writer.write(order(1));
  reader.take([](const msg::KickOrder&) {});
  const auto end = std::chrono::steady_clock::now() + milliseconds(1000);
  while (std::chrono::steady_clock::now() < end) {
    writer.assert_liveliness();
    reader.wait(milliseconds(20));
  }
  EXPECT_EQ(reader.liveliness().alive, 1u);
}

}  // namespace
}  // namespace trivela::bus
