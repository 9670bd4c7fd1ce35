#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "idl/messages.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// What a node of a match takes or stores; in lockstep a first sample waits for all of its readers.
template <bus::Message... In>
struct Inputs {
  template <class T>
  static constexpr std::size_t of() {
    return (std::size_t{std::is_same_v<T, In>} + ... + 0);
  }
};

using OdometryInputs = Inputs<msg::DeviceWheels, msg::DriveCommand, msg::TeamDrive, msg::WorldState>;
using WorldStateInputs = Inputs<msg::Odometry, msg::VisionFrame, msg::Referee, msg::KickerStatus>;
using KickDecisionInputs =
    Inputs<msg::WorldState, msg::KickerStatus, msg::KickOutcome, msg::Referee, msg::KickerEstimate>;
using KickerDriverInputs = Inputs<msg::DeviceKicker, msg::KickOrder, msg::Referee, msg::DriveCommand>;
using ShotObserverInputs = Inputs<msg::KickReceipt, msg::FlightFrame, msg::Referee, msg::KickDecision>;
using ScanRecorderInputs = Inputs<msg::SimScan, msg::KickReceipt>;  // where it is enabled

/// Looked on at: nobody waits for the node that watches the kicker.
using KickerDriftInputs = Inputs<msg::KickDecision, msg::KickReceipt, msg::KickOutcome>;

/// What the recorder leaves out: the devices' own, what is on the team's bus alone, and what the log says itself.
using NotRecorded = Inputs<msg::DeviceWheels, msg::DeviceGyro, msg::DeviceDrive, msg::DeviceKicker, msg::DeviceFire,
                           msg::DeviceCharge, msg::SimScan, msg::StepDone, msg::TeamState, msg::KickerDrift>;

/// How many nodes of a match read T.
template <bus::Message T>
std::size_t readers_of(const config::Settings& settings) {
  constexpr std::size_t always = OdometryInputs::of<T>() + WorldStateInputs::of<T>() + KickDecisionInputs::of<T>() +
                                 KickerDriverInputs::of<T>() + ShotObserverInputs::of<T>() + (1 - NotRecorded::of<T>());
  return always + (settings.scan_recorder.enabled ? ScanRecorderInputs::of<T>() : 0);
}

/// Waits until all are there that read `output`; throws std::runtime_error when they do not come.
template <bus::Message T>
void expect_readers(const NodeContext& context, const bus::Output<T>& output) {
  const std::size_t n = readers_of<T>(context.settings);
  if (output.wait_for_readers(n, kLockstepTimeout)) return;
  throw std::runtime_error{output.topic() + " has " + std::to_string(output.readers()) + " of " + std::to_string(n) +
                           " readers after 20 s"};
}

/// The same for who feeds the nodes and starts before them: false: the stop was requested first.
template <bus::Message T>
[[nodiscard]] bool readers_before_stop(const NodeContext& context, const bus::Writer<T>& output) {
  const std::size_t n = readers_of<T>(context.settings);
  return ready_before_stop(
      context.stop, [&](auto timeout) { return output.wait_for_readers(n, timeout); },
      "not all of " + std::to_string(n) + " readers of " + output.topic() + " are there");
}

}  // namespace trivela::nodes
