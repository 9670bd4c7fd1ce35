// `trivela emulate`: a board that is not there, and the backend that a robot would open it with.
#include <gmock/gmock.h>

#include <signal.h>

#include <chrono>

#include "hal/board/board_kicker.hpp"
#include "hal/can/can_line.hpp"
#include "hal/ioboard/io_board.hpp"
#include "hal/rekick/rekick.hpp"
#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

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

  Folder folder_;
};

TEST_F(Emulate, AnIoBoardIsFoundAtTheAddressThatItPrintsAndSaysItsPulses) {
  Program trivela{"trivela", {"emulate", "ioboard", "--faults", "lost=7"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const config::IoBoardDevice settings{.port = trivela.output().substr(0, trivela.output().find('\n'))};
  hal::BoardKicker kicker{std::make_unique<hal::ioboard::IoBoard>(hal::serial_line(settings.port), settings),
                          std::chrono::seconds(20)};
  ASSERT_TRUE(kicker.connected(kPatience)) << kicker.status();
  kicker.fire(1, 100.0, now_ns());
  EXPECT_TRUE(says(trivela, "pulse of 12.800 ms\n")) << trivela.output();
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, AReKickIsFoundAtTheAddressThatItPrintsAndSaysItsPulses) {
  Program trivela{"trivela", {"emulate", "rekick", "--faults", "lost=7,strangers=2"}, folder_.path()};
  ASSERT_TRUE(says(trivela, "\n")) << trivela.errors();
  const config::ReKickDevice settings{.port = trivela.output().substr(0, trivela.output().find('\n'))};
  hal::BoardKicker kicker{std::make_unique<hal::rekick::ReKick>(hal::can::can_line(settings.port), settings),
                          std::chrono::seconds(20)};
  ASSERT_TRUE(kicker.connected(kPatience)) << kicker.status();
  kicker.fire(1, 30.0, now_ns());
  EXPECT_TRUE(says(trivela, "pulse of 1.000 ms\n")) << trivela.output();
  trivela.signal(SIGTERM);
  EXPECT_EQ(trivela.wait(), 0) << trivela.errors();
}

TEST_F(Emulate, AFaultThatIsNoneIsBadUsage) {
  for (const std::string board : {"ioboard", "rekick"}) {
    for (const std::string fault : {"lost", "lost=0", "lost=x", "burn=1"}) {
      Program trivela{"trivela", {"emulate", board, "--faults", fault}, folder_.path()};
      EXPECT_EQ(trivela.wait(), 2);
      EXPECT_THAT(trivela.errors(), HasSubstr("--faults " + fault + ": expected"));
    }
  }
}

}  // namespace
}  // namespace trivela::e2e
