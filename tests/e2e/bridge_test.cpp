// Devices behind a program in C that knows Trivela by its messages' definition alone: examples/bridge and
// examples/vision, with the nodes and the recorder that a robot has.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "bus/domain/domain.hpp"
#include "bus/node.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "log/read/reader.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::int64_t steady_ns() { return Clock::now().time_since_epoch().count(); }

config::Settings settings_for(const tests::Folder& folder) {
  config::Settings settings = config::load_settings(TRIVELA_SOURCE_DIR "/config/default.toml");
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("bridge-{}-{:08x}", getpid(), random());
  settings.recorder.log = folder / "match.db";
  return settings;
}

bus::ReaderOptions everything() { return {.period = {}, .keep_all = true, .on_liveliness = {}}; }

/// As the robot's own decision node.
bus::WriterOptions own_decision() {
  return {
      .period = {}, .lease = std::chrono::hours{1}, .strength = 0, .owner = bus::owner_of_robot("kick_decision", 1)};
}

class BehindABridge : public testing::Test {
 protected:
  BehindABridge() { std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_); }

  void start(const std::string& node) {
    programs_[node] = std::make_unique<Program>("trivela-" + node, std::vector<std::string>{"--config", "nodes.toml"},
                                                folder_.path());
  }
  /// A program of another language: where the bus is comes from its environment.
  void start_example(const std::string& name) {
    const auto prepare = [this] {
      setenv("CYCLONEDDS_URI", "file://" TRIVELA_SOURCE_DIR "/config/cyclonedds/loopback.xml", 1);
      setenv("TRIVELA_TAG", settings_.domain.tag.c_str(), 1);
    };
    programs_[name] = std::make_unique<Program>(fmt::format("examples/{0}/{0}", name),
                                                std::vector<std::string>{std::to_string(settings_.domain.domain_id)},
                                                folder_.path(), prepare);
  }
  Program& program(const std::string& name) { return *programs_.at(name); }
  void stop(const std::string& name) {
    program(name).signal(SIGTERM);
    EXPECT_EQ(program(name).wait(), 0) << name << ": " << program(name).errors();
  }

  tests::Folder folder_;
  config::Settings settings_ = settings_for(folder_);
  bus::Participant participant_{bus::loopback(settings_.domain.domain_id, settings_.domain.tag)};

 private:
  std::map<std::string, std::unique_ptr<Program>> programs_;
};

/// What a robot's other nodes say, and what its base and kicker make of it.
class Driven : public BehindABridge {
 protected:
  void SetUp() override {
    start_example("bridge");
    for (const char* const node : {"recorder", "odometry", "kicker_driver"}) start(node);
  }

  /// Plays and drives ahead until it is so; false: it does not become so.
  template <class Condition>
  bool drives_until(const Condition& met) {
    const auto deadline = Clock::now() + kTimeout;
    while (!met() && Clock::now() < deadline) {
      msg::Referee word{};
      msg::DriveCommand command{};
      word.robot_id = command.robot_id = 1;
      word.seq = command.seq = ++seq_;
      word.t_ns = command.t_ns = steady_ns();
      word.playing = true;
      command.vy_mps = 0.5;
      referee_.write(word);
      drive_.write(command);
      status_.wait(std::chrono::milliseconds{10});
      status_.take([&](const msg::KickerStatus& status) { ready_ = status.ready; });
      odometry_.take([&](const msg::Odometry& odometry) { speed_mps_ = odometry.vy_mps; });
      receipt_.take([&](const msg::KickReceipt& receipt) { receipts_.push_back(receipt); });
    }
    return met();
  }
  void order(std::int64_t kick_id) {
    msg::KickOrder order{};
    order.robot_id = 1;
    order.seq = ++orders_;
    order.kick_id = kick_id;
    order.power = 30.0;
    order.possession = true;
    order.t_ns = steady_ns();
    order.fire_t_ns = order.t_ns + 15'000'000;
    order.valid_until_t_ns = order.t_ns + 50'000'000;
    order_.write(order);
  }

  bool ready_ = false;
  double speed_mps_ = 0.0;
  std::vector<msg::KickReceipt> receipts_;

 private:
  bus::Writer<msg::Referee> referee_{participant_};
  bus::Writer<msg::DriveCommand> drive_{participant_, own_decision()};
  bus::Writer<msg::KickOrder> order_{participant_, own_decision()};
  bus::Reader<msg::KickerStatus> status_{participant_};
  bus::Reader<msg::Odometry> odometry_{participant_, everything()};
  bus::Reader<msg::KickReceipt> receipt_{participant_, everything()};
  std::uint64_t seq_ = 0;
  std::uint64_t orders_ = 0;
};

TEST_F(Driven, ItMovesKicksOnceAtTheInstantAndIsNotedAsAProgram) {
  ASSERT_TRUE(drives_until([this] { return speed_mps_ > 0.4; })) << program("odometry").errors();
  ASSERT_TRUE(drives_until([this] { return ready_; })) << program("kicker_driver").errors();
  std::int64_t kick_id = 0;
  const auto shot = [&] { return program("bridge").output().find("shot") != std::string::npos; };
  while (!shot() && kick_id < 5) {  // on a busy machine it may come too late and be dropped
    ASSERT_TRUE(drives_until([this] { return ready_; }));
    order(++kick_id);
    const auto done = [&] {
      return program("bridge").output().find(fmt::format(" {} of ", kick_id)) != std::string::npos;
    };
    ASSERT_TRUE(drives_until([&] { return receipts_.size() >= static_cast<std::size_t>(kick_id); }));
    ASSERT_TRUE(receipts_.back().accepted) << bus::label(receipts_.back().refusal);
    ASSERT_TRUE(drives_until(done));
  }
  ready_ = true;
  ASSERT_TRUE(drives_until([this] { return !ready_; })) << "the shot took the charge";
  ASSERT_TRUE(drives_until([this] { return ready_; }));
  const std::string output = program("bridge").output();
  long long id = 0, t_ns = 0;
  double power = 0.0;
  ASSERT_EQ(std::sscanf(output.c_str() + output.find("shot"), "shot %lld of %lf at %lld", &id, &power, &t_ns), 3)
      << output;
  EXPECT_EQ(output.find("shot", output.find("shot") + 1), std::string::npos) << output;
  EXPECT_EQ(id, kick_id);
  EXPECT_EQ(power, 30.0);
  EXPECT_GE(t_ns, receipts_.back().fired_t_ns);

  for (const char* const name : {"kicker_driver", "odometry", "bridge", "recorder"}) stop(name);
  const log::Reader log{folder_ / "match.db"};
  ASSERT_THAT(log.sessions(), SizeIs(1));
  EXPECT_TRUE(log.sessions()[0].simulated) << "the bridge says that it is a program";
  EXPECT_FALSE(log.sessions()[0].seed) << "and no world is behind it";
}

/// A bridge whose board can be told to charge and to empty itself.
class Charged : public BehindABridge {
 protected:
  /// Says that the switch is closed, the game on and the capacitor half full, and where there is one, what the decision
  /// node says; until it is told `word`. False: it is not, for so long.
  bool says_until_told(msg::ChargeWord word, std::chrono::nanoseconds at_most = kTimeout) {
    const auto deadline = Clock::now() + at_most;
    for (std::optional<msg::ChargeWord> told; told != word;) {
      if (Clock::now() > deadline) return false;
      if (decision_) drive();
      msg::Referee referee{};
      msg::DeviceKicker board{};
      referee.robot_id = board.robot_id = 1;
      referee.seq = board.seq = ++seq_;
      referee.t_ns = board.t_ns = steady_ns();
      referee.playing = board.armed = board.charge_control = board.discharge = true;
      board.charge = 0.5;
      board.voltage_v = std::nan("");
      referee_.write(referee);
      board_.write(board);
      charge_.wait(std::chrono::milliseconds{10});
      charge_.take([&](const msg::DeviceCharge& said) { told = said.word; });
    }
    return true;
  }

  void decide() { decision_.emplace(participant_, own_decision()); }
  void fall_silent() { decision_.reset(); }

 private:
  void drive() {
    msg::DriveCommand command{};
    command.robot_id = 1;
    command.seq = ++seq_;
    command.t_ns = steady_ns();
    decision_->write(command);
  }

  std::optional<bus::Writer<msg::DriveCommand>> decision_;  // none: there is no decision node
  bus::Writer<msg::Referee> referee_{participant_};
  bus::Writer<msg::DeviceKicker> board_{participant_};
  bus::Reader<msg::DeviceCharge> charge_{participant_};  // as any bridge has it: keeps the last
  std::uint64_t seq_ = 0;
};

TEST_F(Charged, ItIsToldToEmptyItselfByADriverThatIsAskedToStop) {
  decide();
  start("kicker_driver");
  ASSERT_TRUE(says_until_told(msg::CHARGE_UP)) << program("kicker_driver").errors();
  program("kicker_driver").signal(SIGTERM);
  EXPECT_TRUE(says_until_told(msg::CHARGE_EMPTY));
  EXPECT_EQ(program("kicker_driver").wait(), 0);
}

// 0.2 s, and the cycle of a sample.
TEST_F(Charged, ItIsToldToEmptyItselfWhenTheDecisionNodeFallsSilent) {
  decide();
  start("kicker_driver");
  ASSERT_TRUE(says_until_told(msg::CHARGE_UP)) << program("kicker_driver").errors();
  fall_silent();
  const auto since = Clock::now();
  EXPECT_TRUE(says_until_told(msg::CHARGE_EMPTY)) << program("kicker_driver").errors();
  EXPECT_LT(Clock::now() - since, std::chrono::milliseconds{500}) << "and what a busy machine adds";
  EXPECT_THAT(program("kicker_driver").errors(), HasSubstr("the decision node is gone"));
  decide();
  EXPECT_TRUE(says_until_told(msg::CHARGE_UP)) << "it is back";
}

TEST_F(Charged, ItIsNotToldToChargeBeforeADecisionNodeWasHeard) {
  start("kicker_driver");
  ASSERT_TRUE(says_until_told(msg::CHARGE_HOLD)) << program("kicker_driver").errors();
  EXPECT_FALSE(says_until_told(msg::CHARGE_UP, std::chrono::seconds{1}));
  decide();
  EXPECT_TRUE(says_until_told(msg::CHARGE_UP)) << program("kicker_driver").errors();
}

TEST_F(BehindABridge, VisionAndGoalCameraAreHeard) {
  bus::Reader<msg::VisionFrame> vision{participant_};
  bus::Reader<msg::FlightFrame> camera{participant_};
  const std::int64_t before_ns = steady_ns();
  start_example("vision");
  msg::VisionFrame seen{};
  msg::FlightFrame ball{};
  const auto deadline = Clock::now() + kTimeout;
  while ((seen.seq == 0 || ball.seq == 0) && Clock::now() < deadline) {
    vision.wait(std::chrono::milliseconds{20});
    vision.take([&](const msg::VisionFrame& frame) { seen = frame; });
    camera.take([&](const msg::FlightFrame& frame) { ball = frame; });
  }
  EXPECT_TRUE(seen.pose_seen && seen.ball_seen && !seen.opponent_seen);
  EXPECT_EQ(seen.ball_y_m, 0.3);
  EXPECT_GT(seen.t_exposure_ns, before_ns);
  EXPECT_GT(seen.t_ns, seen.t_exposure_ns);
  EXPECT_LE(seen.t_ns, steady_ns());
  EXPECT_EQ(ball.ball_z_m, 0.11);
  EXPECT_GT(ball.t_ns, ball.t_exposure_ns);
  stop("vision");
}

}  // namespace
}  // namespace trivela::e2e
