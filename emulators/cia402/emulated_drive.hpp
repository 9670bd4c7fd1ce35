#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "hal/can/can_line.hpp"
#include "hal/cia402/canopen.hpp"
#include "hal/cia402/drive_state.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::hal::cia402 {

/// The shaft of an emulated drive: from one speed to another along a ramp.
class Motor {
 public:
  /// From now_ns on towards target_rpm, by at most ramp_rpmps [rpm/s].
  void turn(double target_rpm, double ramp_rpmps, std::int64_t now_ns) {
    if (target_rpm == target_rpm_ && ramp_rpmps == ramp_rpmps_) return;
    start_rpm_ = rpm(now_ns);
    start_ns_ = now_ns;
    target_rpm_ = target_rpm;
    ramp_rpmps_ = ramp_rpmps;
  }
  double rpm(std::int64_t now_ns) const {
    const double change_rpm = ramp_rpmps_ * std::max(0.0, kicking::seconds(start_ns_, now_ns));
    return start_rpm_ + std::clamp(target_rpm_ - start_rpm_, -change_rpm, change_rpm);
  }
  /// When it has come, or will come to rest; none: it is to turn.
  std::optional<std::int64_t> rest_ns() const {
    if (target_rpm_ != 0.0) return std::nullopt;
    return start_ns_ + kicking::nanoseconds(start_rpm_ == 0.0 ? 0.0 : std::abs(start_rpm_) / ramp_rpmps_);
  }

 private:
  double start_rpm_ = 0.0;
  std::int64_t start_ns_ = 0;
  double target_rpm_ = 0.0;
  double ramp_rpmps_ = 1.0;
};

/// What an emulated drive is told to do wrong.
struct EmulatedDriveFaults {
  bool silent = false;             ///< says nothing, but obeys
  bool deaf = false;               ///< hears nothing
  bool refuses_heartbeat = false;  ///< has no object 1016
  bool forgets_heartbeat = false;  ///< object 1016 stays zero
};

/// A maxon EPOS2 as its object dictionary and CiA 402 have it: NMT, SDO, mapped PDOs, the states, profile velocity in
/// rpm by ramps, a heartbeat, and the one that it watches: without it a quick stop, then a fault. What is there after a
/// reset: `factory`. Times and ramps are computed for their own instants, however late somebody asks.
class EmulatedDrive {
 public:
  using Frames = std::vector<can::Frame>;
  static constexpr std::int64_t kBootTime_ns = 20'000'000;

  explicit EmulatedDrive(std::uint8_t node);

  void take(const can::Frame& frame, std::int64_t now_ns, Frames& out);
  void tick(std::int64_t now_ns, Frames& out);
  std::int64_t next_ns() const;

  /// An emergency with a fault: the motor is braked, then without voltage.
  void fail(std::uint16_t code, std::int64_t now_ns, Frames& out);
  /// As if it had lost its power for a moment.
  void power_cycle(std::int64_t now_ns) { boot(now_ns); }

  struct Entry {
    std::uint32_t value = 0;
    std::size_t size = 4;
  };
  using Dictionary = std::map<std::uint32_t, Entry>;  // by key()
  static std::uint32_t key(Object object) { return std::uint32_t{object.index} << 8U | object.sub; }
  Dictionary factory;
  /// Velocity that it measures, in its unit; in place of its motor's. None: its motor's.
  std::optional<double> measured_rpm{};
  EmulatedDriveFaults faults;

  std::uint8_t node() const { return node_; }
  DriveState state() const { return state_; }
  /// The velocity that it was told [rpm], and that of its shaft.
  std::int32_t target_rpm() const;
  double rpm(std::int64_t now_ns) const { return motor_.rpm(now_ns); }
  /// When its motor has come, or will come to rest; none: it turns.
  std::optional<std::int64_t> rest_ns() const { return motor_.rest_ns(); }
  /// When it last heard the heartbeat that it watches.
  std::int64_t received_ns() const { return received_ns_; }
  /// SYNCs that it answered.
  std::uint64_t answers() const { return answers_; }
  std::uint64_t boots() const { return boots_; }
  std::uint64_t resets() const { return resets_; }  ///< of faults

 private:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  void boot(std::int64_t now_ns);
  void take_nmt(const can::Frame& frame, std::int64_t now_ns);
  void take_sdo(const SdoRequest& request, std::int64_t now_ns, Frames& out);
  std::uint32_t refusal(const SdoRequest& request) const;
  void take_pdo(const can::Frame& frame, std::int64_t now_ns, Frames& out);
  void answer_sync(std::int64_t now_ns, Frames& out);
  void write(Object object, std::uint32_t value, std::int64_t now_ns);
  std::uint32_t read(Object object, std::int64_t now_ns) const;
  void control(std::uint16_t controlword, std::int64_t now_ns);
  void step_up(unsigned command, std::int64_t now_ns);
  void lose_master(Frames& out);
  void settle(std::int64_t now_ns);
  std::uint32_t value(Object object) const;
  bool pdo_valid(std::uint16_t communication) const;
  std::int64_t consumer_due_ns() const;
  void say(const can::Frame& frame, Frames& out) const;

  std::uint8_t node_;
  Dictionary objects_;
  NodeState nmt_ = NodeState::kPreOperational;
  DriveState state_ = DriveState::kSwitchOnDisabled;
  Motor motor_;
  std::uint16_t controlword_ = 0;
  std::optional<std::int64_t> boot_ns_;  // it comes up then
  std::int64_t heartbeat_ns_ = 0;        // its last heartbeat
  bool watching_ = false;
  std::int64_t received_ns_ = 0;
  std::uint64_t answers_ = 0;
  std::uint64_t boots_ = 0;
  std::uint64_t resets_ = 0;
};

}  // namespace trivela::hal::cia402
