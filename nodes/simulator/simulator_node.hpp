#pragma once

#include <optional>

#include "kicking/geometry/time.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/progress_line.hpp"
#include "nodes/simulator/emulated_devices.hpp"
#include "nodes/simulator/recent_receipts.hpp"
#include "nodes/simulator/referee_repeats.hpp"
#include "sim/match.hpp"

namespace trivela::nodes {

/// The world of run.scenario. Throws std::runtime_error naming file, key and values where these settings cannot be
/// played in it.
sim::Scenario scenario_of(const config::Settings& settings);

/// Plays the match: samples out, commands in, cycle by cycle; in lockstep as fast as the nodes answer or, where there
/// is a pace, no faster than that, otherwise in real time. The world's time begins at 0. In lockstep it is every t_ns
/// on the bus; in real time those are of the steady clock, so that a simulator that is started again goes on where the
/// nodes are; and the referee's word comes as a referee box's does, not in each cycle. A fire that reaches the
/// simulated coil long after its instant energises nothing, and without a drive command for odometry.drive_timeout_s
/// the base stands.
///
/// With emulated devices the kicker's board, the base's drives and the referee box are in place of their topics, and
/// the world begins when the robot's nodes are there. A pulse is what the coil does, whenever it comes; its kick is
/// that of the receipt. The devices go on after the match until the stop is requested, so that no node loses them
/// before it ends.
class SimulatorNode {
 public:
  /// `devices`: emulated ones, or nullptr: all are topics.
  explicit SimulatorNode(NodeContext& context, EmulatedDevices* devices = nullptr);

  /// Plays until the match is over or the stop is requested. Prints "t_s total_s" lines on standard output about five
  /// times a second, for whoever shows progress.
  void run();

  /// Simulated time played so far.
  double played_s() const { return kicking::seconds(t_ns_); }

 private:
  void play();
  bool nodes_are_here();
  void refuse_twins();
  void say_settings();
  bool has_drives() const { return devices_ != nullptr && devices_->has_drives(); }
  void publish(const sim::Sensors& sensors);
  void publish_referee(const sim::Sensors& sensors);
  void publish_scans(const sim::Sensors& sensors);
  bool await_cycle(std::int64_t t_ns);
  bool wait_until(std::int64_t until_ns) const;
  std::optional<sim::Commands> commands(std::int64_t t_ns);
  void publish_truth(const sim::StepEvents& events);
  void report_progress();

  template <class T>
  void write(bus::Writer<T>& writer, T message, std::uint64_t seq);
  bool is_of_the_driver(const msg::DeviceFire& fire, const bus::SampleInfo& info);
  void order(const msg::DeviceFire& fire, sim::Commands& out);
  void take_pulses(sim::Commands& out);
  std::int64_t kick_of_pulse(std::int64_t t_ns);
  std::optional<msg::DeviceDrive> fresh_drive();
  std::uint8_t wanted_lever_kind();

  NodeContext& context_;
  EmulatedDevices* const devices_;  // of this or an earlier stay on the bus
  sim::Scenario scenario_;
  sim::Match match_;
  bus::Writer<msg::DeviceWheels> wheels_;
  bus::Writer<msg::VisionFrame> vision_;
  bus::Writer<msg::FlightFrame> flight_;
  bus::Writer<msg::KickTruth> kick_truth_;
  bus::Writer<msg::PossessionTruth> possession_truth_;
  std::optional<bus::Writer<msg::SimScan>> scan_;          // where the scenario has a laser
  std::optional<bus::Writer<msg::DeviceKicker>> kicker_;   // where it has no board
  std::optional<bus::Writer<msg::Referee>> referee_;       // where there is no box
  std::optional<bus::Reader<msg::KickReceipt>> receipts_;  // where the kicker has a board
  RecentReceipts recent_;
  RefereeRepeats referee_repeats_;
  bus::Mailbox<msg::DeviceDrive> drive_;
  bus::Reader<msg::DeviceFire> fire_;
  bus::Mailbox<msg::DeviceCharge> charge_;
  LockstepBarrier barrier_;
  std::int64_t t_ns_ = 0;
  std::uint64_t cycle_ = 0;
  std::uint64_t fires_ = 0;
  std::uint64_t kicks_ = 0;
  std::uint64_t possessions_ = 0;
  std::uint64_t scans_ = 0;
  std::uint64_t referee_words_ = 0;
  std::int64_t started_ns_ = 0;  // on the steady clock; 0 in lockstep
  std::int64_t next_ns_ = 0;     // on the steady clock: the next cycle begins no sooner, in lockstep at a pace
  ProgressLine progress_;
};

}  // namespace trivela::nodes
