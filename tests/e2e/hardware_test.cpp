// `trivela hardware`: an emulated robot's devices, listed and tried by somebody at a pseudo-terminal.
#include <gmock/gmock.h>

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <memory>
#include <thread>

#include "bus/domain/domain.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "emulators/cia402/emulated_wheels.hpp"
#include "emulators/ioboard/emulated_board.hpp"
#include "emulators/mti/emulated_mti.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "emulators/rekick/emulated_board.hpp"
#include "emulators/scip/emulator.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/program.hpp"
#include "tests/e2e/typed_terminal.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class Hardware : public testing::Test {
 protected:
  /// A robot with the emulated ioBoard, on a bus of its own.
  Arguments on_the_board(Arguments what) const {
    what.insert(what.begin(), "hardware");
    for (const std::string& setting :
         {std::string{"domain.domain_id=63"}, "domain.tag=\"hardware-" + folder_.path().filename().string() + "\"",
          std::string{"hal.kicker=\"ioboard\""}, std::string{"hal.ioboard.charge_time_s=0.5"},
          "hal.ioboard.port=\"" + board_.address() + "\""}) {
      what.emplace_back("--set");
      what.push_back(setting);
    }
    return what;
  }

  std::unique_ptr<Program> start(const Arguments& arguments) const {
    return std::make_unique<Program>("trivela", arguments, folder_.path(), [this] { person_.become_input(); });
  }

  /// What the program does once somebody has answered its question.
  int answered(Program& trivela, const std::string& keys) const {
    EXPECT_TRUE(wait_for_change(folder_.path(), trivela.watch(), [&] {
      return trivela.output().find("press Enter") != std::string::npos;
    })) << trivela.errors();
    person_.type(keys);
    return trivela.wait();
  }

  std::size_t pulses() {
    std::size_t count = 0;
    board_.with_board([&](const auto& board) { count = board.pulses().size(); });
    return count;
  }

  tests::Folder folder_;
  TypedTerminal person_;
  hal::ioboard::Emulator board_;
};

TEST_F(Hardware, TheTypedWordFiresOneKickWithTheLowestSetPoint) {
  const auto trivela = start(on_the_board({"--kick", "--armed"}));
  EXPECT_EQ(answered(*trivela, "kick\n"), 0) << trivela->errors();
  EXPECT_THAT(trivela->output(), HasSubstr("fired with set-point 15.00"));
  EXPECT_THAT(trivela->output(), HasSubstr("No referee is asked"));
  EXPECT_THAT(trivela->output(), HasSubstr("the shot comes by itself within"));
  ASSERT_EQ(pulses(), 1u);
  board_.with_board([](const auto& board) { EXPECT_EQ(board.pulses().front().units, 15); });
}

TEST_F(Hardware, SaysWhichFiguresTheRobotsFileLeavesToTheDefaults) {
  std::ofstream{folder_ / "thin.toml"} << "[table]\npowers = [10, 12]\nexit_speeds_mps = [4, 5]\n";
  const auto trivela = start(on_the_board({"--seconds", "0.1", "--set", "run.robot='thin.toml'"}));
  trivela->wait();
  EXPECT_THAT(trivela->output(), HasSubstr("not in thin.toml, so defaults hold: base, kicker\n"));
}

TEST_F(Hardware, AnotherWordFiresNothing) {
  const auto trivela = start(on_the_board({"--kick", "--armed"}));
  EXPECT_EQ(answered(*trivela, "yes\n"), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("not confirmed: nothing was fired"));
  EXPECT_EQ(pulses(), 0u);
}

TEST_F(Hardware, AnOpenSwitchIsRefusedBeforeAnybodyIsAsked) {
  board_.with_board([](auto& board) { board.in_play = false; });
  const auto trivela = start(on_the_board({"--kick", "--armed"}));
  EXPECT_EQ(trivela->wait(), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("refused, unarmed"));
  EXPECT_EQ(trivela->output().find("Lay the ball"), std::string::npos);
  EXPECT_EQ(pulses(), 0u);
}

TEST_F(Hardware, ASwitchThatIsOpenedAfterTheQuestionIsRefusedByTheGateOfTheDriver) {
  const auto trivela = start(on_the_board({"--kick", "--armed"}));
  ASSERT_TRUE(wait_for_change(folder_.path(), trivela->watch(),
                              [&] { return trivela->output().find("press Enter") != std::string::npos; }));
  EXPECT_THAT(trivela->output(), testing::ContainsRegex("kicker: charge [^\n]*, armed"));
  board_.with_board([](auto& board) { board.in_play = false; });
  person_.type("kick\n");
  EXPECT_EQ(trivela->wait(), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("refused, unarmed"));
  EXPECT_EQ(pulses(), 0u);
}

TEST_F(Hardware, NothingIsFiredWhereNobodyCanAnswerOrSomebodyStopsIt) {
  Program piped{"trivela", on_the_board({"--kick", "--armed"}), folder_.path(), [] { ::close(STDIN_FILENO); }};
  EXPECT_EQ(piped.wait(), 1);
  EXPECT_THAT(piped.errors(), HasSubstr("standard input is no terminal"));
  const auto stopped = start(on_the_board({"--kick", "--armed"}));
  ASSERT_TRUE(wait_for_change(folder_.path(), stopped->watch(),
                              [&] { return stopped->output().find("press Enter") != std::string::npos; }));
  stopped->signal(SIGTERM);
  EXPECT_EQ(stopped->wait(), 1);
  EXPECT_EQ(pulses(), 0u);
}

TEST_F(Hardware, ADriverThatRunsKeepsItsKicker) {
  Arguments settings = on_the_board({});
  settings.front() = "--config";
  settings.insert(settings.begin() + 1, TRIVELA_SOURCE_DIR "/config/default.toml");
  Program driver{"trivela-kicker_driver", settings, folder_.path()};
  ASSERT_TRUE(wait_for_change(folder_.path(), driver.watch(), [&] {
    return driver.errors().find("ioBoard version") != std::string::npos;
  })) << driver.errors();
  const auto trivela = start(on_the_board({"--kick", "--armed"}));
  EXPECT_EQ(trivela->wait(), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("kicker_driver of robot 1 runs"));
  driver.signal(SIGTERM);
  EXPECT_EQ(driver.wait(), 0);
}

TEST_F(Hardware, ItListsWhatIsThereAndFailsWhereADeviceIsNot) {
  const hal::rekick::Emulator rekick;
  const auto trivela =
      start({"hardware", "--set", "domain.domain_id=64", "--set", "domain.tag=\"hardware\"", "--set",
             "hal.kicker=\"rekick\"", "--set", "hal.rekick.port=\"" + rekick.address() + "\"", "--seconds", "1"});
  EXPECT_EQ(trivela->wait(), 1) << trivela->errors();
  EXPECT_THAT(trivela->output(), testing::ContainsRegex("wheels +bus +NOT THERE"));
  EXPECT_THAT(trivela->output(), HasSubstr("rekick on " + rekick.address()));
  EXPECT_THAT(trivela->output(), HasSubstr("volts are measured"));
  EXPECT_THAT(trivela->output(), testing::ContainsRegex("kicker: charge [01][.][0-9]+, [0-9]+ V, armed"));
  EXPECT_THAT(trivela->output(), HasSubstr("not used: refbox.group is empty"));
}

TEST_F(Hardware, EverythingThatTheConfigurationOpensHasItsRowAndItsValue) {
  hal::cia402::Emulator drives{std::uint8_t{3}};
  hal::mti::Emulator gyro;
  gyro.with_board([](hal::mti::EmulatedMti& mti) { mti.rate_radps = 1.25; });
  const hal::scip::Emulator scanner{hal::scip::EmulatorConfig{}, [t_ns = std::int64_t{0}]() mutable {
                                      t_ns += 25'000'000;
                                      return kicking::lob::Scan{t_ns, std::vector<std::uint32_t>(1081, 2000)};
                                    }};
  const hal::refbox::EmulatedBox box{{}};
  const auto trivela = start(on_the_board({"--seconds", "1",
                                           "--set",     "hal.wheels=\"cia402\"",
                                           "--set",     "hal.cia402.gear=12",
                                           "--set",     "hal.cia402.heartbeat_s=1",
                                           "--set",     "hal.cia402.port=\"" + drives.address() + "\"",
                                           "--set",     "hal.gyro=\"mti\"",
                                           "--set",     "hal.mti.port=\"" + gyro.address() + "\"",
                                           "--set",     "scan_recorder.enabled=true",
                                           "--set",     "scan_recorder.device=\"" + scanner.address() + "\"",
                                           "--set",     "refbox.group=\"224.16.32.39\"",
                                           "--set",     "refbox.port=" + std::to_string(box.port())}));
  EXPECT_EQ(trivela->wait(), 0) << trivela->errors() << trivela->output();
  for (const std::string row : {"wheels +cia402 on .* there: 3 wheels, no gyro", "gyro +mti on .* there: .*MTi",
                                "kicker +ioboard on .* there: ", "range finder +/.* there: Trivela SCIP emulator",
                                "referee box +tcp://127.0.0.1:[0-9]+ +there"})
    EXPECT_THAT(trivela->output(), testing::ContainsRegex(row));
  for (const std::string value : {"wheels: wheel 1 0.00, ", "gyro: 1.25 rad/s, [0-9]+ ms old", "kicker: charge ",
                                  "range finder: 2.00 m in front; [0-9]+/s", "referee box: last command WELCOME"})
    EXPECT_THAT(trivela->output(), testing::ContainsRegex(value));
  drives.with_board([](const hal::cia402::EmulatedDrives& base) {
    for (const auto& drive : base.drives()) {
      EXPECT_EQ(drive.state(), hal::cia402::DriveState::kSwitchOnDisabled) << "its motor has no power";
      EXPECT_EQ(drive.boots() + drive.resets(), 0u) << "a fault would be gone";
    }
  });
}

TEST_F(Hardware, ACableThatWasLooseForAWhileIsNamedAndFails) {
  const hal::cia402::Emulator drives{std::uint8_t{3}};
  const auto trivela =
      start(on_the_board({"--seconds", "6", "--set", "hal.wheels=\"cia402\"", "--set", "hal.cia402.gear=12", "--set",
                          "hal.cia402.heartbeat_s=1", "--set", "hal.cia402.port=\"" + drives.address() + "\""}));
  const auto lines = [&] { return std::ranges::count(trivela->output(), '\n'); };
  const auto more_lines = [&](std::ptrdiff_t than) {
    return wait_for_change(folder_.path(), trivela->watch(), [&] { return lines() > than; });
  };
  ASSERT_TRUE(wait_for_change(folder_.path(), trivela->watch(), [&] {
    return trivela->output().find("kicker: charge") != std::string::npos;
  })) << trivela->errors();
  board_.line().pull();
  ASSERT_TRUE(more_lines(lines() + 1));
  board_.line().plug();
  EXPECT_EQ(trivela->wait(), 1) << trivela->output();
  EXPECT_EQ(trivela->errors(), "trivela: kicker did not answer all the time: is its cable loose?\n");
}

TEST_F(Hardware, AnEmulatedBoardOfAProcessOfItsOwnSaysAPulseOnce) {
  Program board{"trivela-emulate", {"ioboard"}, folder_.path()};
  const auto count = [&] {
    std::size_t n = 0;
    for (auto at = board.output().find("pulse of"); at != std::string::npos;
         at = board.output().find("pulse of", at + 1))
      ++n;
    return n;
  };
  ASSERT_TRUE(
      wait_for_change(folder_.path(), board.watch(), [&] { return board.output().find('\n') != std::string::npos; }));
  Arguments settings = on_the_board({"--kick", "--armed"});
  settings.back() = "hal.ioboard.port=\"" + board.output().substr(0, board.output().find('\n')) + "\"";
  for (std::size_t kicks = 1; kicks <= 2; ++kicks) {
    const auto trivela = start(settings);
    EXPECT_EQ(answered(*trivela, "kick\n"), 0) << trivela->errors();
    EXPECT_TRUE(wait_for_change(folder_.path(), board.watch(), [&] { return count() >= kicks; })) << board.output();
    EXPECT_EQ(count(), kicks);
  }
}

/// Drives of a process of their own, as a team that has none yet tries --spin.
class SpunDrives : public Hardware {
 protected:
  SpunDrives() : drives_("trivela-emulate", {"cia402", "--drives", "3"}, folder_.path()) {
    EXPECT_TRUE(wait_for_change(folder_.path(), drives_.watch(), [this] {
      return drives_.output().find('\n') != std::string::npos;
    })) << drives_.errors();
  }
  std::unique_ptr<Program> spin() const {
    return start(
        on_the_board({"--spin", "2", "--seconds", "1", "--set", "hal.wheels=\"cia402\"", "--set", "hal.cia402.gear=12",
                      "--set", "hal.cia402.heartbeat_s=1", "--set", "hal.cia402.ramp=1000000", "--set",
                      "hal.cia402.port=\"" + drives_.output().substr(0, drives_.output().find('\n')) + "\""}));
  }
  bool say(const std::string& what) {
    return wait_for_change(folder_.path(), drives_.watch(),
                           [&] { return drives_.output().find(what) != std::string::npos; });
  }

  Program drives_;
};

TEST_F(SpunDrives, TheTypedWordTurnsOneWheelAndLeavesItAtRest) {
  const auto trivela = spin();
  EXPECT_EQ(answered(*trivela, "spin 2\n"), 0) << trivela->errors();
  EXPECT_THAT(trivela->output(),
              testing::ContainsRegex("asked wheel 2 for 2.00 rad/s; wheel 1 0.00, wheel 2 (1.9|2.0)"));
  EXPECT_TRUE(say("the wheels turn\n")) << drives_.output();
  EXPECT_TRUE(say("the wheels stand\n")) << drives_.output();
}

TEST_F(SpunDrives, AnotherWordTurnsNothing) {
  const auto trivela = spin();
  EXPECT_EQ(answered(*trivela, "spin 1\n"), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("not confirmed: no wheel was turned"));
  EXPECT_EQ(drives_.output().find("the wheels turn"), std::string::npos);
  EXPECT_EQ(drives_.output().find("drive "), std::string::npos) << "no state was left: " << drives_.output();
}

/// A bridge to four wheels that turn as they are told, on the bus of on_the_board().
class FourWheelBridge : public Hardware {
 protected:
  FourWheelBridge() {
    std::ifstream known{TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml"};
    std::ofstream robot{folder_ / "robot.toml"};
    for (std::string line; std::getline(known, line);)
      robot << (line.starts_with("wheel_angles_rad") ? "wheel_angles_rad = [0.7, 2.4, 3.9, 5.5]" : line) << '\n';
  }
  std::unique_ptr<Program> spin() const {
    return start(on_the_board({"--spin", "4", "--seconds", "1", "--set", "run.robot=\"robot.toml\""}));
  }

  std::atomic<bool> alone_ = true;     ///< it knows wheels_alone
  std::atomic<double> most_radps_{0};  ///< that the fourth wheel turned with
  std::atomic<double> last_radps_{0};

 private:
  void drive(const std::stop_token& stop) {
    const bus::Participant participant{bus::loopback(63, "hardware-" + folder_.path().filename().string())};
    bus::Reader<msg::DeviceDrive> drives{participant};
    bus::Writer<msg::DeviceWheels> wheels{participant};
    msg::DeviceWheels said{};
    said.robot_id = 1;
    said.wheel_count = 4;
    said.gyro_radps = std::nan("");
    while (!stop.stop_requested()) {
      drives.wait(std::chrono::milliseconds{10});
      drives.take([&](const msg::DeviceDrive& told) {
        for (std::size_t i = 0; i < 4; ++i)
          said.wheel_radps[i] = alone_ && told.wheels_alone ? told.wheel_radps[i] : 0.0;
      });
      most_radps_ = std::max<double>(most_radps_, said.wheel_radps[3]);
      last_radps_ = said.wheel_radps[3];
      ++said.seq;
      said.t_ns = std::chrono::steady_clock::now().time_since_epoch().count();
      wheels.write(said);
    }
  }
  std::jthread bridge_{[this](const std::stop_token& stop) { drive(stop); }};
};

TEST_F(FourWheelBridge, TurnsOneWheelAndLeavesItAtRest) {
  const auto trivela = spin();
  EXPECT_EQ(answered(*trivela, "spin 4\n"), 0) << trivela->errors();
  EXPECT_THAT(trivela->output(), HasSubstr("asked wheel 4 for 2.00 rad/s; wheel 1 0.00, wheel 2 0.00, wheel 3 0.00, "
                                           "wheel 4 2.00 rad/s"));
  EXPECT_EQ(most_radps_, 2.0);
  EXPECT_EQ(last_radps_, 0.0);
}

TEST_F(FourWheelBridge, StandsWhereItKnowsVelocitiesAlone) {
  alone_ = false;
  const auto trivela = spin();
  EXPECT_EQ(answered(*trivela, "spin 4\n"), 1);
  EXPECT_THAT(trivela->errors(), HasSubstr("wheel 4: it did not turn"));
}

TEST_F(Hardware, FlagsThatMakeNoSenseAreBadUsage) {
  for (const auto& [arguments, says] :
       std::vector<std::pair<Arguments, std::string>>{{{"--kick"}, "it needs --armed"},
                                                      {{"--armed"}, "--armed goes with --kick"},
                                                      {{"--spin", "4"}, "has wheels 1 to 3"},
                                                      {{"--spin", "1", "--seconds", "11"}, "10 s at most"},
                                                      {{"--spin", "1", "--kick", "--armed"}, "excludes"}}) {
    const auto trivela = start(on_the_board(arguments));
    EXPECT_EQ(trivela->wait(), 2) << says;
    EXPECT_THAT(trivela->errors(), HasSubstr(says));
  }
}

}  // namespace
}  // namespace trivela::e2e
