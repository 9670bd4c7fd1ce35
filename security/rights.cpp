#include "security/rights.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "nodes/runtime/readers.hpp"

namespace trivela::security {
namespace {

template <class... In>
std::vector<std::string> topics(nodes::Inputs<In...> = {}) {
  return {std::string(bus::meta<In>::topic)...};
}

template <bus::Message... T>
std::vector<std::string> these() {
  return topics<T...>();
}

std::vector<std::string> operator+(std::vector<std::string> some, std::vector<std::string> more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

std::vector<std::string> recorded() {
  std::vector<std::string> all;
  bus::for_each_message([&]<class T>() {
    if (nodes::NotRecorded::of<T>() == 0) all.emplace_back(bus::meta<T>::topic);
  });
  return all;
}

// The live page's: what the simulator says of itself and of its truth is nobody's to see in a match.
std::vector<std::string> looked_at() {
  std::vector<std::string> all;
  bus::for_each_message([&]<class T>() {
    if (!bus::meta<T>::topic.starts_with("sim/")) all.emplace_back(bus::meta<T>::topic);
  });
  return all;
}

// Where the device is behind a bridge, its client in the node speaks on the bus too (hal/bus).
std::vector<Rights> of_the_chain() {
  using namespace msg;
  return {
      {"odometry", these<Odometry, DeviceDrive, DeviceEmulated, StepDone>(),
       topics(nodes::OdometryInputs{}) + these<DeviceGyro>()},
      {"world_state", these<WorldState>(), topics(nodes::WorldStateInputs{})},
      {"kick_decision", these<KickDecision, KickOrder, DriveCommand, StepDone>(), topics(nodes::KickDecisionInputs{})},
      {"kick_decision_second", these<KickDecision, KickOrder, DriveCommand, StepDone>(),
       topics(nodes::KickDecisionInputs{}) + these<DriveCommand>()},
      {"kicker_driver", these<KickerStatus, KickReceipt, DeviceFire, DeviceCharge, DeviceEmulated, StepDone>(),
       topics(nodes::KickerDriverInputs{}) + these<WorldState>()},
      {"shot_observer", these<KickOutcome, StepDone>(), topics(nodes::ShotObserverInputs{})},
      {"kicker_drift", these<KickerDrift>(), topics(nodes::KickerDriftInputs{})},
      {"recorder", these<StepDone>(), recorded(), true, true},
      {"scan_recorder", these<DeviceEmulated, StepDone>(), topics(nodes::ScanRecorderInputs{})},
      {"refbox", these<Referee, DeviceEmulated>(), these<WorldState, TeamHeard>(), true, true},
      {"team_link", these<TeamHeard, Referee>(),
       these<WorldState, KickerStatus, KickDecision, Referee, VisionFrame, DriveCommand>(), true, true},
      {"monitor", {}, looked_at()},
  };
}

std::vector<Rights> of_the_world() {
  using namespace msg;
  return {
      {"bridge", these<DeviceWheels, DeviceGyro, DeviceKicker>(), these<DeviceDrive, DeviceFire, DeviceCharge>()},
      {"vision", these<VisionFrame>(), {}},
      {"goal_camera", these<FlightFrame>(), {}},
      {"team", these<TeamDrive>(), {}},
      {"simulator",
       these<DeviceWheels, DeviceKicker, VisionFrame, FlightFrame, Referee, SimScan, KickTruth, PossessionTruth>(),
       these<DeviceDrive, DeviceFire, KickReceipt, StepDone>(), false},
      {"replay_player", these<VisionFrame, FlightFrame, Referee>(), these<StepDone>(), false},
  };
}

}  // namespace

const std::vector<Rights>& all_rights() {
  static const std::vector<Rights> all = [] {
    std::vector<Rights> rights = of_the_chain();
    for (Rights& of_one : of_the_world()) rights.push_back(std::move(of_one));
    return rights;
  }();
  return all;
}

const Rights& rights_of(std::string_view node) {
  const auto found = std::ranges::find(all_rights(), node, &Rights::node);
  if (found != all_rights().end()) return *found;
  std::vector<std::string> known;
  for (const Rights& rights : all_rights()) known.push_back(rights.node);
  throw std::invalid_argument{fmt::format("\"{}\" is no kind of node; there are {}", node, fmt::join(known, ", "))};
}

Rights rights_on_team_bus(std::uint32_t robot_id) {
  using namespace msg;
  if (robot_id == 0) return {"team_bus", these<TeamState, Referee>(), these<TeamState>()};
  return {"team_bus", these<TeamState>(), these<TeamState, Referee>()};
}

std::string common_name(std::string_view node, std::uint32_t robot_id) { return fmt::format("{}.{}", node, robot_id); }

}  // namespace trivela::security
