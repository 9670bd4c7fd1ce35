#include "security/rights.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

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

/// Of the messages T for which fits<T>() holds.
std::vector<std::string> topics_where(const auto& fits) {
  std::vector<std::string> all;
  bus::for_each_message([&]<class T>() {
    if (fits.template operator()<T>()) all.emplace_back(bus::meta<T>::topic);
  });
  return all;
}

std::vector<std::string> recorded() {
  return topics_where([]<class T>() { return nodes::NotRecorded::of<T>() == 0; });
}

// The live page's: what the simulator says of itself and of its truth is nobody's to see in a match.
std::vector<std::string> looked_at() {
  return topics_where([]<class T>() { return !bus::meta<T>::topic.starts_with("sim/"); });
}

std::vector<std::string> written_by(std::string_view node) {
  return topics_where([node]<class T>() { return std::ranges::count(bus::meta<T>::writers, node) > 0; });
}

enum class Runs { kOnRobot, kOnRobotAndBase, kWhereAskedFor };

Rights rights(std::string node, std::vector<std::string> reads, Runs runs = Runs::kOnRobot) {
  std::vector<std::string> writes = written_by(node);
  return {std::move(node), std::move(writes), std::move(reads), runs != Runs::kWhereAskedFor,
          runs == Runs::kOnRobotAndBase};
}

/// Of one process that is all of `nodes`.
Rights rights_together(std::string process, std::initializer_list<Rights> nodes) {
  Rights all{.node = std::move(process), .publish = {}, .subscribe = {}, .on_robot = false};
  for (const Rights& node : nodes) {
    all.publish = all.publish + node.publish;
    all.subscribe = all.subscribe + node.subscribe;
  }
  for (auto* const topics : {&all.publish, &all.subscribe}) {
    std::ranges::sort(*topics);
    topics->erase(std::unique(topics->begin(), topics->end()), topics->end());
  }
  return all;
}

}  // namespace

const std::vector<Rights>& all_rights() {
  using namespace msg;
  static const Rights odometry = rights("odometry", topics(nodes::OdometryInputs{}) + these<DeviceGyro>());
  static const Rights world_state = rights("world_state", topics(nodes::WorldStateInputs{}));
  static const Rights kick_decision = rights("kick_decision", topics(nodes::KickDecisionInputs{}));
  static const std::vector<Rights> all{
      odometry,
      world_state,
      kick_decision,
      rights("kick_decision_second", topics(nodes::KickDecisionInputs{}) + these<DriveCommand>()),
      rights("kicker_driver", topics(nodes::KickerDriverInputs{}) + these<WorldState>()),
      rights("shot_observer", topics(nodes::ShotObserverInputs{})),
      rights("kicker_drift", topics(nodes::KickerDriftInputs{})),
      rights("recorder", recorded(), Runs::kOnRobotAndBase),
      rights("scan_recorder", topics(nodes::ScanRecorderInputs{})),
      rights("refbox", these<WorldState, TeamHeard>(), Runs::kOnRobotAndBase),
      rights("team_link", these<WorldState, KickerStatus, KickDecision, Referee, VisionFrame, DriveCommand>(),
             Runs::kOnRobotAndBase),
      rights("monitor", looked_at()),
      rights("bridge", these<DeviceDrive, DeviceFire, DeviceCharge>()),
      rights("vision", {}),
      rights("goal_camera", {}),
      rights("team", {}),
      rights_together("chain", {odometry, world_state, kick_decision}),
      rights("simulator", these<DeviceDrive, DeviceFire, DeviceCharge, KickReceipt, StepDone>(), Runs::kWhereAskedFor),
  };
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
  const std::string node = "team_bus";
  const auto of_all = written_by(node);
  const auto of_base = written_by(common_name(node, 0));
  if (robot_id == 0) return {node, of_all + of_base, of_all};
  return {node, of_all, of_all + of_base};
}

std::string common_name(std::string_view node, std::uint32_t robot_id) { return fmt::format("{}.{}", node, robot_id); }

}  // namespace trivela::security
