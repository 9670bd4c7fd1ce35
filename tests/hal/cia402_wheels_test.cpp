// The drives' backend with its thread, on a socket of packets in place of a CAN bus, against emulated drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "tests/hal/cia402_rig.hpp"

namespace trivela::hal::cia402 {
namespace {

using std::chrono::milliseconds;
using tests::kTimeout;

bool turn(const EmulatedDrives& drives) {
  return std::ranges::all_of(drives.drives(), [](const EmulatedDrive& drive) { return drive.target_rpm() != 0; });
}
bool stand(const EmulatedDrives& drives) {
  return std::ranges::all_of(drives.drives(),
                             [](const EmulatedDrive& drive) { return drive.rpm(tests::steady_ns()) == 0.0; });
}

bool until_status_says(Wheels& wheels, const std::string& text) {
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  while (wheels.status().find(text) == std::string::npos) {
    if (std::chrono::steady_clock::now() > end) return false;
    wheels.read(milliseconds(20));
  }
  return true;
}

/// A process of its own that drives, until it is killed. It is made while this one has a single thread.
class DrivingProcess {
 public:
  DrivingProcess() {
    EXPECT_EQ(::pipe(pipe_), 0);
    id_ = ::fork();
    if (id_ == 0) drive();
    ::close(pipe_[0]);
  }
  ~DrivingProcess() {
    kill();
    ::close(pipe_[1]);
  }
  DrivingProcess(const DrivingProcess&) = delete;
  DrivingProcess& operator=(const DrivingProcess&) = delete;

  void connect_to(const std::string& port) const {
    EXPECT_EQ(::write(pipe_[1], port.data(), port.size()), static_cast<ssize_t>(port.size()));
  }
  void kill() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
    id_ = 0;
  }

 private:
  [[noreturn]] void drive() const {
    ::close(pipe_[1]);
    std::array<char, 256> port{};
    const ssize_t size = ::read(pipe_[0], port.data(), port.size());
    if (size <= 0) ::_exit(1);
    const config::Cia402Device settings{.port = {port.data(), static_cast<std::size_t>(size)}, .gear = 12.0};
    Cia402Wheels wheels{can::can_line(settings.port), settings, kicking::WheelBase{}};
    for (;;) {
      wheels.drive({0.0, 0.0, 2.0}, tests::steady_ns());
      wheels.read(kTimeout);
    }
  }

  int pipe_[2] = {-1, -1};
  pid_t id_ = 0;
};

TEST(Cia402Process, ThatIsKilledLeavesWheelsThatStandWithinTheHeartbeatsTime) {
  DrivingProcess process;
  Emulator emulator{std::uint8_t{3}};
  process.connect_to(emulator.address());
  const auto whirl = [](const EmulatedDrive& drive) { return drive.rpm(tests::steady_ns()) > 1000.0; };
  ASSERT_TRUE(emulator.wait(kTimeout, [&](const auto& drives) { return std::ranges::all_of(drives.drives(), whirl); }));
  process.kill();
  ASSERT_TRUE(emulator.wait(kTimeout, stand));
  emulator.with_board([](const EmulatedDrives& drives) {
    for (const EmulatedDrive& drive : drives.drives()) {
      // 200 ms without our heartbeat, then the ramp of the quick stop: 1008 rpm by 10000 rpm/s.
      constexpr std::int64_t kHeartbeat_ns = 200'000'000, kRamp_ns = 101'000'000;
      ASSERT_TRUE(drive.rest_ns());
      EXPECT_LE(*drive.rest_ns(), drive.received_ns() + kHeartbeat_ns + kRamp_ns);
      EXPECT_NE(drive.state(), DriveState::kEnabled);
    }
  });
}

class Cia402WheelsTest : public testing::Test {
 protected:
  tests::DrivesOnALine line_;
  Wheels& wheels_ = *line_.device;
};

TEST_F(Cia402WheelsTest, SamplesAreNewAndOfInstantsThatPassed) {
  std::int64_t last_ns = 0;
  for (int i = 0; i < 10; ++i) {
    const auto sample = wheels_.read(kTimeout);
    ASSERT_TRUE(sample);
    EXPECT_GT(sample->t_ns, last_ns);
    EXPECT_LE(sample->t_ns, tests::steady_ns());
    last_ns = sample->t_ns;
  }
}

TEST_F(Cia402WheelsTest, APulledCableIsSaidAndTheWheelsStand) {
  wheels_.drive({0.0, 0.0, 2.0}, 1);
  ASSERT_TRUE(line_.emulator.wait(kTimeout, turn));
  line_.emulator.line().pull();
  EXPECT_TRUE(until_status_says(wheels_, "no bus " + line_.emulator.address()));
  wheels_.drive({}, 2);
  line_.emulator.line().plug();
  EXPECT_TRUE(until_status_says(wheels_, line_.emulator.address() + ": "));
  EXPECT_TRUE(line_.emulator.wait(kTimeout, stand));
}

TEST_F(Cia402WheelsTest, AFaultIsSaidWithItsCause) {
  line_.emulator.with_board([](EmulatedDrives& drives) { drives.fail(2, 0x3220, tests::steady_ns()); });
  EXPECT_TRUE(until_status_says(wheels_, "drive 2: fault: undervoltage (3220); start this program again to reset it"));
  EXPECT_FALSE(wheels_.connected(milliseconds(0)));
}

TEST_F(Cia402WheelsTest, TheNextProgramResetsTheFault) {
  line_.emulator.with_board([](EmulatedDrives& drives) { drives.fail(2, 0x3220, tests::steady_ns()); });
  ASSERT_TRUE(until_status_says(wheels_, "undervoltage"));
  line_.device.reset();
  line_.device = tests::DrivesOnALine::open(line_.emulator.address());
  EXPECT_TRUE(line_.device->connected(kTimeout)) << line_.device->status();
}

TEST_F(Cia402WheelsTest, ACableThatWasOutUntilTheDrivesMissedUsIsPluggedInAndTheyObeyAgain) {
  line_.device.reset();
  line_.device = tests::DrivesOnALine::open(line_.emulator.address(), 0.5);
  ASSERT_TRUE(line_.device->connected(kTimeout));
  line_.emulator.line().pull();
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  for (bool missed = false; !missed; std::this_thread::yield()) {
    ASSERT_LT(std::chrono::steady_clock::now(), end);
    line_.emulator.with_board([&](EmulatedDrives& drives) {
      drives.tick(tests::steady_ns());  // what they say nobody hears
      missed =
          std::ranges::all_of(drives.drives(), [](const auto& drive) { return drive.state() == DriveState::kFault; });
    });
  }
  line_.emulator.line().plug();
  ASSERT_TRUE(line_.device->connected(kTimeout)) << line_.device->status();
  EXPECT_TRUE(line_.emulator.wait(kTimeout, [this](const EmulatedDrives& drives) {
    line_.device->drive({0.0, 0.0, 2.0}, tests::steady_ns());
    return turn(drives);
  }));
}

TEST(Cia402Wheels, WithoutABusSayWhyAndGiveNothing) {
  const auto wheels = tests::DrivesOnALine::open("/nowhere/can");
  EXPECT_FALSE(wheels->connected(milliseconds(1)));
  EXPECT_FALSE(wheels->read(milliseconds(1)));
  EXPECT_TRUE(until_status_says(*wheels, "no bus /nowhere/can: no such file or directory"));
}

}  // namespace
}  // namespace trivela::hal::cia402
