// `trivela-emulate`: a board that is not there, and the backend that a robot would open it with.
#include <gmock/gmock.h>

#include <signal.h>

#include <chrono>
#include <thread>

#include "hal/board/board_kicker.hpp"
#include "hal/can/can_line.hpp"
#include "hal/cia402/cia402_wheels.hpp"
#include "hal/ioboard/io_board.hpp"
#include "hal/mti/mti.hpp"
#include "hal/rekick/rekick.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

class Emulate : public testing::Test {
 protected:
  bool says(const Program& program, const std::string& text) const {
    return wait_for_change(folder_.path(), program.watch(),
                           [&] { return program.output().find(text) != std::string::npos; });
  }

  tests::Folder folder_;
};

TEST_F(Emulate, AnIoBoardIsFoundAtTheAddressThatItPrintsAndSaysItsPulses) {
  Program trivela{"trivela-emulate", {"ioboard", "--faults", "lost=7"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const config::IoBoardDevice settings{.port = trivela.output().substr(0, trivela.output().find('\n'))};
  hal::BoardKicker kicker{std::make_unique<hal::ioboard::IoBoard>(hal::serial_line(settings.port), settings)};
  ASSERT_TRUE(kicker.connected(kTimeout)) << kicker.status();
  kicker.fire({1, 100.0, now_ns()});
  EXPECT_TRUE(says(trivela, "pulse of 12.800 ms\n")) << trivela.output();
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, AReKickIsFoundAtTheAddressThatItPrintsAndSaysItsPulses) {
  Program trivela{"trivela-emulate", {"rekick", "--faults", "lost=7,foreign=2"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const config::ReKickDevice settings{.port = trivela.output().substr(0, trivela.output().find('\n'))};
  hal::BoardKicker kicker{std::make_unique<hal::rekick::ReKick>(hal::can::can_line(settings.port), settings)};
  ASSERT_TRUE(kicker.connected(kTimeout)) << kicker.status();
  kicker.fire({1, 30.0, now_ns()});
  EXPECT_TRUE(says(trivela, "pulse of 1.000 ms\n")) << trivela.output();
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, DrivesAreFoundAtTheAddressThatItPrintsAndSayWhatTheyDo) {
  Program trivela{"trivela-emulate", {"cia402", "--drives", "3"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const config::Cia402Device settings{
      .port = trivela.output().substr(0, trivela.output().find('\n')), .gear = 12.0, .heartbeat_s = 10.0};
  {
    hal::cia402::Cia402Wheels wheels{hal::can::can_line(settings.port), settings, kicking::WheelBase{}};
    ASSERT_TRUE(wheels.connected(kTimeout)) << wheels.status();
    wheels.drive({0.0, 0.0, 2.0}, now_ns());
    EXPECT_TRUE(says(trivela, "drive 3: operation enabled\n")) << trivela.output();
    EXPECT_TRUE(says(trivela, "the wheels turn\n")) << trivela.output();
  }
  EXPECT_TRUE(says(trivela, "the wheels stand\n")) << trivela.output();
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, AnMtiIsFoundAtTheAddressThatItPrints) {
  Program trivela{"trivela-emulate", {"mti", "--rate-radps", "1.5", "--faults", "garbled=5"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const std::string port = trivela.output().substr(0, trivela.output().find('\n'));
  const hal::mti::MtiGyro gyro{hal::serial_line(port), {.port = port}};
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  while (!gyro.newest() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  ASSERT_TRUE(gyro.newest()) << gyro.status();
  EXPECT_EQ(gyro.newest()->gyro_radps, 1.5);
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, AFaultThatIsNoneIsBadUsage) {
  for (const std::string board : {"ioboard", "rekick", "cia402", "mti"}) {
    for (const std::string fault : {"lost", "lost=0", "lost=x", "burn=1"}) {
      Program trivela{"trivela-emulate", {board, "--faults", fault}, folder_.path()};
      EXPECT_EQ(trivela.wait(), 2);
      EXPECT_THAT(trivela.errors(), HasSubstr("--faults " + fault + ": expected"));
    }
  }
}

}  // namespace
}  // namespace trivela::e2e
