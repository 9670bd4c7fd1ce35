#include "cli/calibrate/robot_drives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "cli/calibrate/drive_match.hpp"
#include "cli/hardware/device_locks.hpp"
#include "cli/launch/child_process.hpp"
#include "cli/launch/record_match.hpp"
#include "cli/options/output.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "idl/messages.hpp"
#include "kicking/geometry/time.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kTimeout{2};  // in which a writer that runs is known, on a busy machine too

/// What lacks, by looking for the writers of a topic each, all within the same two seconds.
class Lacking {
 public:
  explicit Lacking(const bus::Participant& participant) : participant_(participant) {}

  template <class T>
  void unless_written(const char* topic, const char* advice) {
    bus::ReaderOptions looks_on;
    looks_on.observer = true;
    bus::Reader<T> reader{participant_, looks_on};
    const auto left = std::max<std::chrono::nanoseconds>(until_ - std::chrono::steady_clock::now(), kShortest);
    if (!reader.wait_for_writers(1, left)) what_.push_back(fmt::format("nobody writes {}: {}", topic, advice));
  }

  const std::vector<std::string>& what() const { return what_; }

 private:
  static constexpr std::chrono::milliseconds kShortest{100};  // whoever runs is known to the participant by now

  const bus::Participant& participant_;
  const std::chrono::steady_clock::time_point until_ = std::chrono::steady_clock::now() + kTimeout;
  std::vector<std::string> what_;
};

/// What a drive on a robot needs of others: `vision`, `flight_camera`, a bridge where wheels or kicker stand behind
/// one, over the scanner a device for it. Throws std::runtime_error naming the drive and everything that lacks, after
/// two seconds in which nobody came.
void require_for_drive(const bus::Participant& participant, const config::Settings& settings,
                       const calibration::DrivePlan& plan) {
  Lacking lacking{participant};
  lacking.unless_written<msg::VisionFrame>("vision", "start your vision, or examples/vision");
  lacking.unless_written<msg::FlightFrame>("flight_camera", "start what follows the ball in flight");
  if (std::holds_alternative<config::BusDevice>(settings.hal.wheels))
    lacking.unless_written<msg::DeviceWheels>("device/wheels", "start the robot's bridge, or set hal.wheels");
  if (std::holds_alternative<config::BusDevice>(settings.hal.kicker))
    lacking.unless_written<msg::DeviceKicker>("device/kicker", "start the robot's bridge, or set hal.kicker");
  if (plan.laser && std::holds_alternative<config::SimDevice>(settings.scan_recorder.device))
    lacking.unless_written<msg::SimScan>(
        "sim/scan",
        "this drive is measured by the scanner: set scan_recorder.device, tcp://HOST:PORT or a serial device");
  if (lacking.what().empty()) return;
  throw std::runtime_error{fmt::format("{} cannot be played: {}", plan.name, fmt::join(lacking.what(), "; "))};
}

using DriveClock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLookAtNodes{100};
constexpr const char* kOwnGroup = "224.16.32.1";  // on the loopback, between this process and its refbox node

/// The nodes of a drive; the recorder ends last.
struct NodesOfADrive {
  std::deque<ChildProcess> running;

  NodesOfADrive(const config::Settings& settings, const fs::path& config_file, bool refbox) {
    for (const std::string& name : nodes_of_match(settings)) running.push_back(start_node(name, config_file));
    if (refbox) running.push_back(start_node("refbox", config_file));
  }
  ~NodesOfADrive() { stop_all(running, 1); }
  NodesOfADrive(const NodesOfADrive&) = delete;
  NodesOfADrive& operator=(const NodesOfADrive&) = delete;
};

/// Publishes START, and STOP when it ends.
class OwnReferee {
 public:
  OwnReferee() : box_({.port = 0, .groups = {kOwnGroup, "224.16.32.2"}}) {}
  ~OwnReferee() { say_word(hal::refbox::CommandKind::kStop); }
  OwnReferee(const OwnReferee&) = delete;
  OwnReferee& operator=(const OwnReferee&) = delete;

  std::uint16_t port() const { return box_.port(); }
  bool start_when_connected() {
    if (!box_.wait_for_teams(1, kLookAtNodes)) return false;
    say_word(hal::refbox::CommandKind::kFirstHalf);
    say_word(hal::refbox::CommandKind::kStart);
    return true;
  }

 private:
  void say_word(hal::refbox::CommandKind kind) { box_.act(hal::refbox::BoxCommand{kind, {}, {}}); }
  hal::refbox::EmulatedBox box_;
};

/// How far the drive has come, by what its nodes say.
class DriveProgress {
 public:
  DriveProgress(const bus::Participant& participant, std::uint8_t robot_id, std::uint32_t kicks, double quiet_s)
      : receipts_(participant),
        decisions_(participant),
        robot_id_(robot_id),
        kicks_(kicks),
        quiet_(kicking::nanoseconds(quiet_s)) {}

  /// True once all is kicked and the last ball has come down.
  bool over() {
    receipts_.take([&](const msg::KickReceipt& receipt) {
      if (receipt.robot_id != robot_id_ || !msg::begins_kick(receipt)) return;
      ++kicked_;
      last_ = DriveClock::now();
      say(fmt::format("  kick {} of {}, set-point {:.2f}\n", kicked_, kicks_, receipt.power));
      std::fflush(stdout);
    });
    decisions_.take([&](const msg::KickDecision& decision) {
      if (decision.robot_id == robot_id_ && decision.reason == msg::REASON_DRIVE_FINISHED) finished_ = true;
    });
    return (finished_ || kicked_ >= kicks_) && DriveClock::now() - last_ > quiet_;
  }
  std::uint32_t kicked() const { return kicked_; }

 private:
  bus::Reader<msg::KickReceipt> receipts_;
  bus::Reader<msg::KickDecision> decisions_;
  std::uint8_t robot_id_;
  std::uint32_t kicks_;
  std::chrono::nanoseconds quiet_;
  std::uint32_t kicked_ = 0;
  bool finished_ = false;
  DriveClock::time_point last_{};
};

/// Throws where somebody else's nodes have the robot. True: somebody writes `referee`.
bool somebody_referees(const bus::Participant& participant, std::uint8_t robot_id) {
  const DeviceLocks claims{participant, robot_id};
  claims.require_wheels();
  claims.require_kicker();
  return claims.referee_is_written();
}

config::Settings settings_of_robot_drive(const calibration::DrivePlan& plan, const calibration::DriveRecord& record,
                                         const fs::path& robot_file, config::Settings settings) {
  settings.run.robot = robot_file.string();
  settings.run.lockstep = false;
  settings.recorder.log = record.log;
  settings.kick_decision.put_in_charge(plan.policy);
  settings.scan_recorder.enabled = plan.laser;
  if (plan.laser) settings.scan_recorder.file = record.scans;
  config::override_settings(settings, plan.settings);
  return settings;
}

}  // namespace

RobotDrives::RobotDrives(config::Settings settings, fs::path folder, fs::path robot_file, SignalInbox& signals)
    : settings_(std::move(settings)),
      folder_(std::move(folder)),
      robot_file_(std::move(robot_file)),
      signals_(signals) {}

calibration::DriveRecord RobotDrives::play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) {
  calibration::DriveRecord record = drive_files(folder_, plan);
  robot.write(robot_file_);
  config::Settings settings = settings_of_robot_drive(plan, record, robot_file_, settings_);
  const auto robot_id = static_cast<std::uint8_t>(settings.run.robot_id);
  const bus::Participant participant{nodes::domain_of(settings.domain)};
  require_for_drive(participant, settings, plan);
  std::optional<OwnReferee> referee;
  if (!somebody_referees(participant, robot_id)) {
    referee.emplace();
    settings.refbox = config::Refbox{};
    settings.refbox.port = referee->port();
    settings.refbox.group = kOwnGroup;
  }
  config::make_files_whole(settings);
  DriveProgress progress{participant, robot_id, plan.possessions, settings.shot_observer.time_out_s};
  const ConfigFile config{config::to_toml_text(settings)};
  const auto began = DriveClock::now();
  NodesOfADrive nodes{settings, config.path(), referee.has_value()};
  std::string trouble;
  for (bool started = !referee; trouble.empty() && !progress.over();) {
    if (!started) started = referee->start_when_connected();
    pollfd inbox{signals_.file_descriptor(), POLLIN, 0};
    ::poll(&inbox, 1, static_cast<int>(kLookAtNodes.count()));
    trouble = signals_.stop_requested() ? "interrupted" : dead_node(nodes.running);
  }
  referee.reset();
  stop_all(nodes.running, 1);
  record.played_s = record.wall_s = std::chrono::duration<double>(DriveClock::now() - began).count();
  if (!trouble.empty())
    throw std::runtime_error{fmt::format("{}: {} after {} of {} kicks; what was recorded until then is in {}",
                                         plan.name, trouble, progress.kicked(), plan.possessions, folder_.string())};
  if (lost_rows(record.log) > 0) throw std::runtime_error{plan.name + ": rows were lost"};
  read_back(record);
  return record;
}

}  // namespace trivela::cli
