// Odometry, as its own process, with emulated CiA 402 drives on its bus while the bus, a drive and the process are
// troubled. The drives' own motors are the witness. By hand, longer: TRIVELA_DEVICE_FAULTS=1000 and
// TRIVELA_DEVICE_SEED.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <optional>

#include "bus/writer.hpp"
#include "emulators/cia402/emulated_wheels.hpp"
#include "hal/can/can_line.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/program.hpp"
#include "tests/faults/device_rounds.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {
namespace {

namespace cia402 = hal::cia402;
using std::chrono::milliseconds;

enum class DriveTrouble { kUnplug, kHold, kSilentDrive, kDeafDrive, kGarbled, kFlood, kKill, kStop, kRestart };
constexpr std::array kDriveTroubles{DriveTrouble::kUnplug,    DriveTrouble::kHold,    DriveTrouble::kSilentDrive,
                                    DriveTrouble::kDeafDrive, DriveTrouble::kGarbled, DriveTrouble::kFlood,
                                    DriveTrouble::kKill,      DriveTrouble::kStop,    DriveTrouble::kRestart};
constexpr std::array kDriveTroubleNames{"unplug",  "hold", "silent drive", "deaf drive", "garbled",
                                        "flooded", "kill", "stop",         "restart"};

/// Wheels may turn on through these, as long as somebody drives.
bool leaves_the_link(DriveTrouble what) { return what == DriveTrouble::kGarbled || what == DriveTrouble::kFlood; }

class DrivesCampaign : public testing::Test {
 protected:
  /// hal.cia402.heartbeat_s and odometry.drive_timeout_s are 0.2 s, and the quick stop of a motor at some 1,150 rpm by
  /// 10,000 rpm/s takes 0.12 s.
  static constexpr std::int64_t kStands_ns = 320 * kMs + kBusy_ns;

  DrivesCampaign() {
    settings_.hal.wheels = config::Cia402Device{.port = drives_.address(), .gear = 12.0};
    std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
    start();
  }

  void start() {
    odometry_.emplace("trivela-odometry", std::vector<std::string>{"--config", "nodes.toml"}, folder_.path());
  }

  void command() {
    msg::DriveCommand out{};
    out.robot_id = 1;
    out.seq = ++commands_;
    out.t_ns = steady_now_ns();
    out.vx_mps = 0.3;
    out.vy_mps = 0.5;
    drive_.write(out);
  }

  /// Whether every drive is in operation and a motor turns.
  bool turns() {
    bool enabled = true, turning = false;
    drives_.with_board([&](const cia402::EmulatedDrives& board) {
      for (const cia402::EmulatedDrive& drive : board.drives()) {
        enabled = enabled && drive.state() == cia402::DriveState::kEnabled;
        turning = turning || drive.rpm(steady_now_ns()) != 0.0;
      }
    });
    return enabled && turning;
  }
  /// Whether every motor is at rest.
  bool stands() {
    bool rests = true;
    drives_.with_board([&](const cia402::EmulatedDrives& board) {
      for (const cia402::EmulatedDrive& drive : board.drives()) rests = rests && drive.rpm(steady_now_ns()) == 0.0;
    });
    return rests;
  }

  /// Lets time go on until then, or `done`, with a command each 10 ms where somebody drives; where the machine stands
  /// still, for so much longer.
  void go_on(
      std::int64_t until_ns, bool driven, const std::function<bool()>& done = [] { return false; }) {
    while (steady_now_ns() < until_ns && !done()) {
      const std::int64_t began_ns = steady_now_ns();
      if (driven) command();
      stir();
      drives_.wait(milliseconds(10), [](const cia402::EmulatedDrives&) { return false; });
      until_ns += stalled_ns(began_ns, 10 * kMs);
    }
  }

  /// Frames of others, errors that the interface reports, and drives' own that were cut short.
  void stir() {
    constexpr int kFrames = 100;  // in 10 ms: what a bus of 1 Mbit/s carries
    const bool floods = what_ == DriveTrouble::kFlood, garbles = what_ == DriveTrouble::kGarbled;
    if (!floods && !garbles) return;
    drives_.with_board([&](cia402::EmulatedDrives& board) {
      for (int i = 0; floods && i < kFrames; ++i) board.say(hal::can::extended_frame(0x40A000, {0xF2, 0xFF, 0xFF}));
      if (!garbles) return;
      board.say({.id = 0x8, .extended = false, .error = true, .size = 8, .data = {}});
      for (const std::uint32_t id : {0x181U, 0x582U, 0x703U}) board.say(hal::can::standard_frame(id, {}));
    });
  }

  void begin(DriveTrouble what) {
    what_ = what;
    if (what == DriveTrouble::kUnplug) drives_.line().pull();
    if (what == DriveTrouble::kHold) drives_.line().hold(true);
    if (what == DriveTrouble::kKill) odometry_->signal(SIGKILL);
    if (what == DriveTrouble::kStop) odometry_->signal(SIGSTOP);
    drives_.with_board([&](cia402::EmulatedDrives& board) {
      board.drive(1).faults.silent = what == DriveTrouble::kSilentDrive;
      board.drive(1).faults.deaf = what == DriveTrouble::kDeafDrive;
    });
    if (what != DriveTrouble::kRestart) return;
    odometry_->signal(SIGTERM);
    EXPECT_EQ(odometry_->wait(), 0) << odometry_->errors();
  }

  void end() {
    if (what_ == DriveTrouble::kUnplug) drives_.line().plug();
    if (what_ == DriveTrouble::kHold) drives_.line().hold(false);
    if (what_ == DriveTrouble::kStop) odometry_->signal(SIGCONT);
    if (what_ == DriveTrouble::kKill) odometry_->wait();
    drives_.with_board([](cia402::EmulatedDrives& board) { board.drive(1).faults = {}; });
    if (what_ == DriveTrouble::kKill || what_ == DriveTrouble::kRestart) start();
    what_.reset();
  }

  /// Trouble for so long, while somebody drives or nobody does; then all is well again, and where nobody drove, nobody
  /// does for a moment more.
  void suffer(DriveTrouble what, bool driven, std::int64_t for_ns) {
    const std::int64_t began_ns = steady_now_ns();
    begin(what);
    const bool has_to_stand = !driven || !leaves_the_link(what);
    go_on(began_ns + kStands_ns, driven);
    const auto turned = [&] { return has_to_stand && !stands(); };
    go_on(began_ns + for_ns, driven, turned);
    EXPECT_FALSE(turned()) << "a wheel turns " << (steady_now_ns() - began_ns) / kMs << " ms after the beginning";
    end();
    if (driven) return;
    const auto turns_by_itself = [this] { return !stands(); };
    go_on(steady_now_ns() + 200 * kMs, false, turns_by_itself);
    EXPECT_FALSE(turns_by_itself()) << "nobody drives since";
  }

  bool recovers(std::int64_t since_ns) {
    go_on(since_ns + kRecovery_ns, true, [this] { return turns(); });
    return turns();
  }

  config::Settings settings_ = settings_of_campaign();
  bus::Participant participant_{
      bus::loopback(static_cast<std::uint32_t>(settings_.domain.domain_id), settings_.domain.tag)};
  tests::Folder folder_;
  cia402::Emulator drives_{std::uint8_t{3}};
  bus::Writer<msg::DriveCommand> drive_{participant_, own_decision()};
  std::optional<e2e::Program> odometry_;
  std::optional<DriveTrouble> what_;
  std::uint64_t commands_ = 0;
};

TEST_F(DrivesCampaign, NoWheelTurnsWithoutItsHostAndAFreshCommandAndAllTurnAgainWithinTwoSeconds) {
  std::mt19937_64 random = device_draws();
  ASSERT_TRUE(recovers(steady_now_ns())) << "no first motion: " << odometry_->errors();
  const std::uint64_t rounds = device_rounds(DeviceCampaigns::kDrives);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::size_t which = round % kDriveTroubles.size();
    const bool driven = random() % 2 == 0;
    SCOPED_TRACE(fmt::format("round {}, {}, {}", round, kDriveTroubleNames[which], driven ? "driven" : "left alone"));
    const std::int64_t for_ns = kStands_ns + static_cast<std::int64_t>(50 + random() % 450) * kMs;
    suffer(kDriveTroubles[which], driven, for_ns);
    const std::int64_t since_ns = steady_now_ns() - (driven ? 0 : 200 * kMs);
    ASSERT_TRUE(recovers(since_ns)) << odometry_->errors();
    if (HasFailure()) break;
  }
  odometry_->signal(SIGTERM);
  EXPECT_EQ(odometry_->wait(), 0) << odometry_->errors();
}

}  // namespace
}  // namespace trivela::faults
