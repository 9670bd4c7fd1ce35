#include "security/rights.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "idl/messages.hpp"
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

namespace {

// config/domain: ids above 100 are refused by bus/domain/domain.cpp.
constexpr const char* kDomains = "<domains><id_range><min>0</min><max>100</max></id_range></domains>";

std::string topic_rule(std::string_view topic, const char* parts) {
  return fmt::format(R"(      <topic_rule>
        <topic_expression>{}</topic_expression>
        <enable_discovery_protection>true</enable_discovery_protection>
        <enable_liveliness_protection>true</enable_liveliness_protection>
        <enable_read_access_control>true</enable_read_access_control>
        <enable_write_access_control>true</enable_write_access_control>
        <metadata_protection_kind>{}</metadata_protection_kind>
        <data_protection_kind>NONE</data_protection_kind>
      </topic_rule>
)",
                     topic, parts);
}

std::string topic_list(const char* verb, const std::vector<std::string>& topics) {
  if (topics.empty()) return {};
  std::string text = fmt::format("      <{}><topics>", verb);
  for (const std::string& topic : topics) text += fmt::format("<topic>{}</topic>", topic);
  return text + fmt::format("</topics></{}>\n", verb);
}

std::string instant(std::chrono::sys_seconds t) { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(t)); }

}  // namespace

std::string governance_xml(Bus bus) {
  const bool robot = bus == Bus::kRobot;
  std::string rules;
  if (robot)
    for (const std::string_view topic :
         {trivela::bus::meta<msg::KickOrder>::topic, trivela::bus::meta<msg::KickerStatus>::topic,
          trivela::bus::meta<msg::Referee>::topic})
      rules += topic_rule(topic, "ENCRYPT");
  rules += topic_rule("*", "NONE");  // the first rule that fits counts
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules><domain_rule>
    {}
    <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
    <enable_join_access_control>true</enable_join_access_control>
    <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
    <liveliness_protection_kind>SIGN</liveliness_protection_kind>
    <rtps_protection_kind>{}</rtps_protection_kind>
    <topic_access_rules>
{}    </topic_access_rules>
  </domain_rule></domain_access_rules>
</dds>
)",
                     kDomains, robot ? "SIGN" : "ENCRYPT", rules);
}

std::string permissions_xml(const Rights& rights, std::uint32_t robot_id, const Validity& validity) {
  const std::string name = common_name(rights.node, robot_id);
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions><grant name="{0}">
    <subject_name>O=Trivela,CN={0}</subject_name>
    <validity><not_before>{1}</not_before><not_after>{2}</not_after></validity>
    <allow_rule>
      {3}
{4}{5}    </allow_rule>
    <default>DENY</default>
  </grant></permissions>
</dds>
)",
                     name, instant(validity.from), instant(validity.to), kDomains,
                     topic_list("publish", rights.publish), topic_list("subscribe", rights.subscribe));
}

}  // namespace trivela::security
