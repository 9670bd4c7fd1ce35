// A driver that is killed with an accepted kick in its hands, seen from outside: the board's clock and the bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "emulators/ioboard/emulated_board.hpp"
#include "idl/messages.hpp"
#include "nodes/kicker_driver/pending_kick.hpp"
#include "tests/nodes/spawned.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::int64_t kMs = 1'000'000;

std::int64_t steady_ns() { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }

class KilledDriver : public testing::Test {
 protected:
  KilledDriver() {
    config.domain_id = 17;
    config.tag = "killed-" + std::to_string(getpid());
    std::ofstream{folder / "node.toml"} << "[domain]\ndomain_id = 17\ntag = \"" << config.tag
                                        << "\"\n[run]\nrobot = \"" TRIVELA_SOURCE_DIR
                                           "/config/robots/cambada_1.toml\"\n[hal]\nkicker = \"ioboard\"\n"
                                           "[hal.ioboard]\ncharge_time_s = 0.0\nport = \""
                                        << emulator.address() << "\"\n";
    participant.emplace(bus::loopback(17, config.tag));
    referee.emplace(*participant);
    drive.emplace(*participant, bus::WriterOptions{.owner = "kick_decision/1"});
    orders.emplace(*participant, bus::WriterOptions{.lease = std::chrono::hours{1}, .owner = "kick_decision/1"});
    statuses.emplace(*participant);
    receipts.emplace(*participant, bus::ReaderOptions{.keep_all = true});
  }
  ~KilledDriver() override { PendingKick{PendingKick::name_of(config, 1)}.settled(); }

  std::unique_ptr<Spawned> start() {
    return std::make_unique<Spawned>(TRIVELA_BINARY_DIR "/trivela-kicker_driver",
                                     std::vector<std::string>{"--config", (folder / "node.toml").string()});
  }
  /// Referee and decision node go on, until `done` or for 30 s.
  bool play_until(const std::function<bool()>& done) {
    for (const auto end = Clock::now() + std::chrono::seconds{30}; Clock::now() < end;) {
      msg::Referee word{};
      word.robot_id = 1;
      word.t_ns = steady_ns();
      word.playing = true;
      referee->write(word);
      msg::DriveCommand command{};
      command.robot_id = 1;
      command.t_ns = word.t_ns;
      drive->write(command);
      if (done()) return true;
      static_cast<void>(statuses->wait(std::chrono::milliseconds{5}));
    }
    return false;
  }
  bool is_ready() {
    statuses->take([this](const msg::KickerStatus& status) { ready = status.ready; });
    return ready;
  }
  /// The first receipt of the kick with this answer.
  bool has_receipt(std::int64_t kick_id, bool accepted) {
    receipts->take([this](const msg::KickReceipt& receipt) { seen.push_back(receipt); });
    return std::ranges::any_of(
        seen, [=](const auto& receipt) { return receipt.kick_id == kick_id && receipt.accepted == accepted; });
  }
  void order(std::int64_t kick_id) {
    msg::KickOrder wish{};
    wish.robot_id = 1;
    wish.kick_id = kick_id;
    wish.t_ns = steady_ns();
    wish.fire_t_ns = wish.t_ns + 19 * kMs;
    wish.valid_until_t_ns = wish.t_ns + 50 * kMs;
    wish.power = 25.0;
    wish.possession = true;
    orders->write(wish);
  }
  std::size_t pulses() {
    std::size_t n = 0;
    emulator.with_board([&](const auto& board) { n = board.pulses().size(); });
    return n;
  }

  tests::Folder folder;
  hal::ioboard::Emulator emulator;
  config::Domain config;
  std::optional<bus::Participant> participant;
  std::optional<bus::Writer<msg::Referee>> referee;
  std::optional<bus::Writer<msg::DriveCommand>> drive;
  std::optional<bus::Writer<msg::KickOrder>> orders;
  std::optional<bus::Reader<msg::KickerStatus>> statuses;
  std::optional<bus::Reader<msg::KickReceipt>> receipts;
  std::vector<msg::KickReceipt> seen;
  bool ready = false;
};

TEST_F(KilledDriver, EveryKickThatItAcceptedHasAPulseOrAReceiptOfItsSuccessor) {
  auto driver = start();
  int lost = 0;
  for (std::int64_t kick_id = 1; kick_id <= 5; ++kick_id) {
    ASSERT_TRUE(play_until([&] { return is_ready(); })) << driver->said();
    const std::size_t before = pulses();
    order(kick_id);
    ASSERT_TRUE(play_until([&] { return has_receipt(kick_id, true) || has_receipt(kick_id, false); }));
    ASSERT_TRUE(has_receipt(kick_id, true)) << "the order was accepted";
    driver->send(SIGKILL);
    driver->exit_code();
    ready = false;
    driver = start();
    ASSERT_TRUE(play_until([&] { return is_ready(); })) << driver->said();
    const bool fired = pulses() > before, told = has_receipt(kick_id, false);
    EXPECT_NE(fired, told) << "kick " << kick_id << " fired " << fired << ", second receipt " << told;
    lost += told ? 1 : 0;
  }
  EXPECT_GT(lost, 0) << "none was killed before its instant";
}

}  // namespace
}  // namespace trivela::nodes
