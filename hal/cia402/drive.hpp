#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/devices.hpp"
#include "hal/can/can_line.hpp"
#include "hal/cia402/drive_state.hpp"
#include "hal/cia402/start_up.hpp"

namespace trivela::hal::cia402 {

/// One drive on an open bus: it is started, brought into operation and watched. It looks at no clock and knows no bus:
/// what it has to say is added to `out`.
///
/// A drive that is silent, restarts by itself or leaves its state is told a quick stop and started again after a pause.
/// Its faults are reset while it comes up for the first time. Afterwards one is, that our heartbeat was missing, once
/// the heartbeat flows again; for any other somebody has to start the program again.
///
/// One that is listened to is told no controlword: it stays in the state and with the fault that it has.
class Drive {
 public:
  using Frames = std::vector<can::Frame>;

  Drive(std::uint8_t node, bool reversed, const config::Cia402Device& settings, WheelsUse use = WheelsUse::kDrive);

  /// The bus was opened, or lost.
  void open(std::int64_t now_ns, Frames& out);
  void close() { stage_ = Stage::kClosed; }

  void take(const can::Frame& frame, std::int64_t now_ns, Frames& out);
  /// What is due though nothing came.
  void step(std::int64_t now_ns, Frames& out);
  std::int64_t next_ns() const;

  /// It takes part in the cycle of SYNC and PDOs.
  bool running() const { return stage_ == Stage::kRunning; }
  /// It turns as it is told.
  bool enabled() const { return running() && state_ == DriveState::kEnabled; }
  /// It has said in which state it is.
  bool received() const { return running() && state_ != DriveState::kUnknown; }

  /// Revolutions a minute of the motor at this speed of the wheel, counter-clockwise about the robot's centre.
  double motor_rpm(double wheel_radps) const;

  /// The cycle's command, after which it has not answered yet.
  can::Frame command(double motor_rpm, std::int64_t now_ns);
  /// The cycle goes round without a command; it has not answered yet.
  void expect_answer(std::int64_t now_ns);
  bool answered() const { return answered_; }
  /// The wheel's speed by its last answer.
  double wheel_radps() const;

  can::Frame quick_stop() const { return rx_pdo(node_, 0, kQuickStopCommand); }

  /// Empty: all is well, and it turns as it is told.
  std::string status() const;
  const Scale& scale() const { return scale_; }

 private:
  enum class Stage { kClosed, kStarting, kPaused, kRunning };

  void start(std::int64_t now_ns, Frames& out);
  void go_on(StartUp::Progress progress, std::int64_t now_ns, Frames& out);
  void ask(std::int64_t now_ns, Frames& out);
  void take_heartbeat(NodeState state, std::int64_t now_ns, Frames& out);
  void take_pdo(const TxPdo& pdo, std::int64_t now_ns);
  void note_error(std::uint16_t code);
  bool lost_us() const { return heartbeat_lost_ && !other_error_; }
  void lose(const std::string& why, std::int64_t now_ns, Frames& out);
  std::string fault() const;

  std::uint8_t node_;
  double sign_;
  config::Cia402Device settings_;
  WheelsUse use_;
  std::int64_t silence_ns_;
  std::optional<StartUp> start_up_;
  Scale scale_;
  Stage stage_ = Stage::kClosed;
  std::int64_t due_ns_ = 0;      // starting: of the answer; paused: of the next start
  std::int64_t running_ns_ = 0;  // since then
  std::int64_t heartbeat_ns_ = 0;
  std::int64_t asked_ns_ = 0;  // of the first SYNC that it has not answered, if `asked_`
  DriveState state_ = DriveState::kUnknown;
  std::uint16_t controlword_ = 0;
  std::int32_t velocity_ = 0;
  std::uint16_t emergency_ = 0;
  bool heartbeat_lost_ = false;  // it said so since it was in operation
  bool other_error_ = false;     // one that is not of the link, the same
  std::int64_t fault_ns_ = 0;    // seen in fault since then, if it is
  bool answered_ = false;        // since the last SYNC
  bool asked_ = false;
  bool was_enabled_ = false;
  bool may_reset_ = true;
  std::string problem_;
};

}  // namespace trivela::hal::cia402
