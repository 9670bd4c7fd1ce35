#include "config/team/team_bus.hpp"

#include <fmt/core.h>

namespace trivela::config {
namespace {

constexpr double kMessageOverheadBytes = 104;
constexpr double kAnnouncementBytes = 480;
constexpr double kSignOfLifeBytes = 100;
constexpr double kRefereeBytes = 120, kRefereeHz = 10;
constexpr double kStateBytes = 300, kBaseStateHz = 10, kRobotStateHz = 5;
constexpr double kKeysBytes = 80;  // of an encrypted message, beside the plain one
constexpr double kBits = 8;

std::string peer_elements(const Team& team) {
  std::string peers;
  const auto add = [&](const std::string& address) { peers += fmt::format("<Peer address=\"{}\"/>", address); };
  for (const TeamRobot& robot : team.robots) add(robot.address);
  add(team.base.address);
  for (const std::string& peer : team.team.peers) add(peer);
  return "      <Peers>" + peers + "</Peers>\n";
}

}  // namespace

std::string team_bus_xml(const Team& team, const std::string& interface) {
  const bool by_group = !team.team.group.empty();
  const std::string where =
      by_group ? fmt::format("      <SPDPMulticastAddress>{}</SPDPMulticastAddress>\n", team.team.group)
               : peer_elements(team);
  return fmt::format(R"(<CycloneDDS xmlns="https://cdds.io/config">
  <Domain Id="any">
    <General>
      <Interfaces><NetworkInterface name="{}"/></Interfaces>
      <AllowMulticast>{}</AllowMulticast>
      <MaxMessageSize>1400B</MaxMessageSize>
      <MaxRexmitMessageSize>1400B</MaxRexmitMessageSize>
      <FragmentSize>1344B</FragmentSize>
    </General>
    <Discovery>
      <Tag>{}</Tag>
      <ParticipantIndex>auto</ParticipantIndex>
      <MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>
      <SPDPInterval>{}s</SPDPInterval>
      <LeaseDuration>10s</LeaseDuration>
{}    </Discovery>
  </Domain>
</CycloneDDS>
)",
                     interface, by_group ? "spdp" : "false", team.team.name, kTeamLastParticipantIndex,
                     team_discovery_interval_s(team), where);
}

AirEstimate air_estimate(const Team& team) {
  const auto robots = static_cast<double>(team.robots.size());
  const double machines = robots + 1;
  const double asked = (robots + static_cast<double>(team.team.peers.size())) * (kTeamLastParticipantIndex + 1);
  const double announcements = machines * (team.team.group.empty() ? asked : 1);
  const double keys = team.team.keys.empty() ? 0.0 : kKeysBytes;
  const double states_hz = robots * kBaseStateHz + robots * robots * kRobotStateHz;
  return {.referee_bps = robots * kRefereeHz * (kRefereeBytes + kMessageOverheadBytes + keys) * kBits,
          .state_bps = states_hz * (kStateBytes + kMessageOverheadBytes + keys) * kBits,
          .discovery_bps = (announcements * kAnnouncementBytes + machines * robots * (kSignOfLifeBytes + keys)) *
                           kBits / team_discovery_interval_s(team)};
}

}  // namespace trivela::config
