// What every backend of Kicker promises, run over each of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "hal/bus/bridge.hpp"
#include "tests/hal/board_on_a_line.hpp"
#include "tests/hal/bus_world.hpp"

namespace trivela::hal {
namespace {

using std::chrono::milliseconds;

const std::vector<KickerSample> kSaid{{20'000'000, 1.0, true, KickerFault::kNone},
                                      {40'000'000, 0.5, false, KickerFault::kCharger},
                                      {60'000'000, 0.625, true, KickerFault::kCoil},
                                      {80'000'000, 0.0, true, KickerFault::kLink}};

struct Fired {
  std::int64_t kick_id;
  double power;
  std::int64_t t_ns;
  bool operator==(const Fired&) const = default;
};

/// A device that says what it is told to, to the nanosecond, and speaks of kicks as it was ordered to.
class ToldDevice {
 public:
  static constexpr std::size_t kCount = 4;  // of kSaid
  static constexpr bool kSpeaksByItself = false;
  static constexpr std::int64_t kAhead_ns = 15'000'000;  // of a clock that stands

  static void expect_said(std::size_t i, const KickerSample& sample) {
    EXPECT_EQ(sample.t_ns, kSaid[i].t_ns);
    EXPECT_EQ(sample.charge, kSaid[i].charge);
    EXPECT_EQ(sample.armed, kSaid[i].armed);
    EXPECT_EQ(sample.fault, kSaid[i].fault);
  }
  /// It was said, and nothing else.
  static void expect_waited(const KickerSample& sample) {
    const auto said = std::ranges::find(kSaid, sample.t_ns, &KickerSample::t_ns);
    ASSERT_NE(said, kSaid.end()) << sample.t_ns << " is no instant of the device";
    EXPECT_EQ(sample.charge, said->charge);
  }
  static bool is_last(const KickerSample& sample) { return sample.t_ns >= kSaid.back().t_ns; }
  static void expect_fired(const std::vector<Fired>& fired, const std::vector<Fired>& ordered) {
    EXPECT_EQ(fired, ordered);
  }
};

class BusRig : public ToldDevice {
 public:
  BusRig() {
    EXPECT_TRUE(device->connected(kPlenty));
    EXPECT_TRUE(marker.connected(kPlenty));
    EXPECT_TRUE(world.commands.wait_for_writers(2, kPlenty));
  }

  void say(std::size_t i) {
    constexpr msg::KickerFault kFaults[] = {msg::FAULT_NONE, msg::FAULT_CHARGER, msg::FAULT_COIL, msg::FAULT_LINK};
    msg::DeviceKicker sample{};
    sample.robot_id = kRobot;
    sample.t_ns = kSaid[i].t_ns;
    sample.charge = kSaid[i].charge;
    sample.armed = kSaid[i].armed;
    sample.fault = kFaults[i];
    now_t_ns = sample.t_ns;
    world.samples.write(sample);
  }

  void wait_for_first() {}
  /// Everything that the coil was told, up to a word that takes the same way after it: the device's own, or where it is
  /// gone that of another.
  std::vector<Fired> energised() {
    Kicker& last = device ? *device : static_cast<Kicker&>(marker);
    last.withdraw(kEnd);
    std::vector<Fired> fired;
    bool over = false;
    while (!over && world.commands.wait(kPlenty)) {
      world.commands.take([&](const msg::DeviceFire& order) {
        over = over || order.kick_id == kEnd;
        if (order.robot_id != kRobot || order.kick_id == kEnd) return;
        if (order.withdrawn)
          std::erase_if(fired, [&](const Fired& f) { return f.kick_id == order.kick_id && f.t_ns > now_t_ns; });
        else
          fired.push_back({order.kick_id, order.power, order.t_ns});
      });
    }
    EXPECT_TRUE(over) << "the last word did not arrive";
    return fired;
  }

  static constexpr std::int64_t kEnd = -1;
  BusWorld<msg::DeviceKicker, msg::DeviceFire> world;
  std::unique_ptr<Kicker> device = std::make_unique<BusKicker>(world.here, kRobot);
  BusKicker marker{world.here, kRobot + 1};
  std::int64_t now_t_ns = 0;  // of the world
};

/// A board at the end of a line: its emulator, and the backend that it makes.
template <class Board>
class BoardRig {
 public:
  static constexpr std::size_t kCount = 4;
  static constexpr bool kSpeaksByItself = true;
  static constexpr std::int64_t kAhead_ns = 1'000'000'000;  // of a clock that runs

  BoardRig() {
    EXPECT_TRUE(device->connected(kPlenty)) << device->status();
    EXPECT_TRUE(tests::read_until(*device, [](const auto& sample) { return sample.fault == KickerFault::kNone; }));
  }

  void say(std::size_t i) {
    said_t_ns_ = tests::steady_ns();
    board.be_well(well(i));
  }
  /// Samples may be of before, until one says what was told.
  void expect_said(std::size_t i, KickerSample sample) {
    while (sample.armed != well(i) || sample.t_ns < said_t_ns_) {
      const std::int64_t before_ns = sample.t_ns;
      sample = device->read(kPlenty).value();
      EXPECT_GT(sample.t_ns, before_ns);
    }
    EXPECT_LE(sample.t_ns, tests::steady_ns());
  }
  void expect_waited(const KickerSample& sample) {
    board.emulator.with_board([&](const auto& emulated) { EXPECT_LE(sample.t_ns, emulated.last_look_ns()); });
  }
  bool is_last(const KickerSample& sample) const { return sample.t_ns > said_t_ns_; }

  /// What the board was told can be withdrawn no more.
  void wait_for_first() {
    EXPECT_TRUE(board.emulator.wait(kPlenty, [](const auto& emulated) { return !emulated.pulses().empty(); }));
  }
  /// What the coil did so far and does within the next while.
  std::vector<Fired> energised() {
    tests::wait_for_looks(board.emulator, 2, tests::steady_ns() + kAhead_ns + 100'000'000);
    std::vector<Fired> fired;
    board.emulator.with_board([&](const auto& emulated) {
      for (const auto& pulse : emulated.pulses()) fired.push_back({0, Board::power_of(pulse), pulse.t_ns});
    });
    return fired;
  }
  /// A board knows neither kick nor order: pulses as long as ordered, in their order, none before its instant.
  void expect_fired(const std::vector<Fired>& fired, const std::vector<Fired>& ordered) {
    ASSERT_EQ(fired.size(), ordered.size()) << device->status();
    for (std::size_t i = 0; i < fired.size(); ++i) {
      EXPECT_EQ(fired[i].power, ordered[i].power);
      EXPECT_GE(fired[i].t_ns, ordered[i].t_ns);
    }
  }

  Board board;
  std::unique_ptr<Kicker> device = board.open();

 private:
  static bool well(std::size_t i) { return i % 2 == 0; }
  std::int64_t said_t_ns_ = 0;
};

template <class Rig>
class KickerContract : public testing::Test {
 protected:
  Rig rig_;
};
using Rigs = testing::Types<BusRig, BoardRig<tests::IoBoardOnALine>, BoardRig<tests::ReKickOnALine>>;
TYPED_TEST_SUITE(KickerContract, Rigs);

TYPED_TEST(KickerContract, SamplesComeWholeAndInTimeOrder) {
  auto& kicker = *this->rig_.device;
  for (std::size_t i = 0; i < TypeParam::kCount; ++i) {
    this->rig_.say(i);
    const auto sample = kicker.read(kPlenty);
    ASSERT_TRUE(sample);
    this->rig_.expect_said(i, *sample);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto beyond = kicker.read(milliseconds(20));
  EXPECT_TRUE(TypeParam::kSpeaksByItself || !beyond);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

/// A process that stood still finds what came meanwhile: each sample still of the instant at which the device took it.
TYPED_TEST(KickerContract, ASampleThatWaitedKeepsItsInstant) {
  auto& kicker = *this->rig_.device;
  for (std::size_t i = 0; i < TypeParam::kCount; ++i) this->rig_.say(i);
  std::int64_t last_t_ns = 0;
  for (bool last = false; !last;) {
    const auto sample = kicker.read(kPlenty);
    ASSERT_TRUE(sample);
    this->rig_.expect_waited(*sample);
    EXPECT_GT(sample->t_ns, last_t_ns);
    last_t_ns = sample->t_ns;
    last = this->rig_.is_last(*sample);
  }
  kicker.fire({11, 22.5, kSaid.front().t_ns});                                        // the driver's word waited, too
  this->rig_.expect_fired(this->rig_.energised(), {{11, 22.5, kSaid.front().t_ns}});  // the device sees its age
}

TYPED_TEST(KickerContract, FiresAtAnyTime) {
  auto& kicker = *this->rig_.device;
  kicker.fire({11, 22.5, 5});
  const std::vector<Fired> first = this->rig_.energised();
  this->rig_.expect_fired(first, {{11, 22.5, 5}});
  this->rig_.say(0);
  kicker.read(kPlenty);
  kicker.fire({12, 50.0, 30'000'000});
  const std::vector<Fired> fired = this->rig_.energised();
  ASSERT_FALSE(fired.empty());
  this->rig_.expect_fired({fired.back()}, {{12, 50.0, 30'000'000}});
}

TYPED_TEST(KickerContract, AKickThatLiesAheadIsCalledOffAndNoOther) {
  auto& kicker = *this->rig_.device;
  this->rig_.say(0);
  const auto sample = kicker.read(kPlenty);
  ASSERT_TRUE(sample);
  constexpr std::int64_t ahead_ns = TypeParam::kAhead_ns;
  kicker.fire({11, 22.5, sample->t_ns - 1});
  this->rig_.wait_for_first();
  kicker.fire({12, 30.0, sample->t_ns + ahead_ns});
  kicker.fire({13, 40.0, sample->t_ns + ahead_ns + 3'000'000});
  kicker.withdraw(12);
  kicker.withdraw(12);
  kicker.withdraw(11);  // was carried out
  kicker.withdraw(99);  // was never ordered
  this->rig_.expect_fired(this->rig_.energised(),
                          {{11, 22.5, sample->t_ns - 1}, {13, 40.0, sample->t_ns + ahead_ns + 3'000'000}});
}

TYPED_TEST(KickerContract, NothingIsEnergisedOnceItIsSafe) {
  auto& kicker = *this->rig_.device;
  kicker.make_safe();
  kicker.make_safe();
  kicker.fire({11, 22.5, 5});
  EXPECT_TRUE(this->rig_.energised().empty());
  this->rig_.say(0);
  EXPECT_TRUE(kicker.read(kPlenty));  // it still speaks
}

template <class Board>
class BoardHost : public testing::Test {};
using Boards = testing::Types<tests::IoBoardOnALine, tests::ReKickOnALine>;
TYPED_TEST_SUITE(BoardHost, Boards);

TYPED_TEST(BoardHost, ASecondOneIsRefusedUntilTheFirstIsGone) {
  TypeParam board;
  auto first = board.open();
  ASSERT_TRUE(first->connected(kPlenty)) << first->status();
  const auto second = board.open();
  ASSERT_TRUE(tests::until_status_says(*second, "another program has it")) << second->status();
  second->fire({11, 22.5, 5});
  tests::wait_for_looks(board.emulator, 5, tests::steady_ns());
  board.emulator.with_board([](const auto& emulated) { EXPECT_TRUE(emulated.pulses().empty()); });
  EXPECT_TRUE(first->connected(kPlenty)) << first->status();
  first.reset();
  EXPECT_TRUE(second->connected(kPlenty)) << second->status();
}

TEST(BusKicker, DestructionEnergisesNothing) {
  BusRig rig;
  rig.device.reset();
  EXPECT_TRUE(rig.energised().empty());
}

TEST(BusKicker, HandsOnWhatTheBoardCanDoAndWhatItMeasures) {
  BusRig rig;
  EXPECT_EQ(rig.device->capabilities(), KickerCapabilities{});
  msg::DeviceKicker sample{};
  sample.robot_id = kRobot;
  sample.t_ns = 20'000'000;
  sample.charge_modelled = true;
  sample.voltage_v = std::nan("");
  rig.world.samples.write(sample);
  const auto modelled = rig.device->read(kPlenty);
  ASSERT_TRUE(modelled);
  EXPECT_TRUE(modelled->charge_modelled);
  EXPECT_EQ(modelled->voltage_v, std::nullopt);
  EXPECT_EQ(rig.device->capabilities(), KickerCapabilities{});
  EXPECT_FALSE(modelled->emulated);

  sample.t_ns = 40'000'000;
  sample.charge_modelled = false;
  sample.voltage_v = 312.5;
  sample.charge_control = sample.discharge = sample.watchdog = sample.emulated = true;
  rig.world.samples.write(sample);
  const auto measured = rig.device->read(kPlenty);
  ASSERT_TRUE(measured);
  EXPECT_FALSE(measured->charge_modelled);
  EXPECT_EQ(measured->voltage_v, 312.5);
  EXPECT_EQ(rig.device->capabilities(),
            (KickerCapabilities{.charge_control = true, .voltage = true, .discharge = true, .watchdog = true}));
  EXPECT_TRUE(measured->emulated);
}

TEST(BusKicker, HasChargedWhatCanBeToldToAndEmptiesItInTheEnd) {
  BusRig rig;
  bus::Reader<msg::DeviceCharge> words{rig.world.there};
  ASSERT_TRUE(words.wait_for_writers(2, kPlenty));  // the marker's, too
  const auto received = [&] {
    msg::DeviceCharge last{};
    EXPECT_TRUE(words.wait(kPlenty));
    words.take([&](const msg::DeviceCharge& word) { last = word; });
    return last;
  };
  rig.device->charge(ChargeCommand::kCharge);  // nobody knows yet whether it can
  msg::DeviceKicker sample{};
  sample.robot_id = kRobot;
  sample.t_ns = 20'000'000;
  sample.charge_control = sample.discharge = true;
  rig.world.samples.write(sample);
  ASSERT_TRUE(rig.device->read(kPlenty));
  rig.device->charge(ChargeCommand::kCharge);
  const msg::DeviceCharge up = received();
  EXPECT_EQ(up.word, msg::CHARGE_UP);
  EXPECT_EQ(up.robot_id, kRobot);
  EXPECT_EQ(up.seq, 1u);
  EXPECT_LE(up.t_ns, tests::steady_ns());
  EXPECT_GT(up.t_ns, tests::steady_ns() - 60'000'000'000);
  rig.device->charge(ChargeCommand::kHold);
  EXPECT_EQ(received().word, msg::CHARGE_HOLD);
  rig.device->make_safe();
  EXPECT_EQ(received().word, msg::CHARGE_EMPTY);
  rig.device->charge(ChargeCommand::kCharge);
  rig.device.reset();  // safe once more
  const msg::DeviceCharge last = received();
  EXPECT_EQ(last.word, msg::CHARGE_EMPTY);
  EXPECT_EQ(last.seq, 4u);
}

}  // namespace
}  // namespace trivela::hal
