#pragma once

#include <string>

#include "config/team/team.hpp"

/// The DDS bus between the machines of a team.
namespace trivela::config {

/// Processes of one machine that may be on the team's bus at once, 0 to this. Without a group every one of these ports
/// of every machine is asked in turn, so that each costs bytes on the air.
inline constexpr unsigned kTeamLastParticipantIndex = 2;

/// How often a machine says on the team's bus that it is there: a robot that was forgotten in an outage is found again
/// within it. Longer among peers, who are asked one by one.
inline unsigned team_discovery_interval_s(const Team& team) { return team.team.group.empty() ? 4 : 2; }

/// Cyclone's configuration of the bus between the machines, for one whose interface is `interface`: messages that no
/// radio has to cut, discovery by the team's group, or by the addresses of robots, base and team.peers.
std::string team_bus_xml(const Team& team, const std::string& interface);

/// What crosses the air, in bits per second with the headers of IP and UDP. An estimate; docs/team.md has what was
/// measured.
struct AirEstimate {
  double referee_bps = 0.0;
  double state_bps = 0.0;
  double discovery_bps = 0.0;

  double total_bps() const { return referee_bps + state_bps + discovery_bps; }
};

/// For R robots and a base, so that each of the M = R + 1 machines has R others. Data goes to each reader by itself.
/// A message has 104 bytes beside its data: 28 of IP and UDP, 20 of RTPS' header, 16 of its destination, 12 of its
/// time, 28 before the data.
/// With keys (`team.keys`) each but an announcement is encrypted as a whole, for K = 80 bytes more: RTPS' security
/// prefix, body and postfix and the source that is repeated inside; 0 without. Measured: 364 bytes in place of 284.
///   referee   = R readers x 10 Hz x (120 + 104 + K) bytes x 8
///   state     = (R readers x 10 Hz of the base + R writers x R readers x 5 Hz) x (300 + 104 + K) bytes x 8
///   discovery = (A announcements x 480 bytes + M x R signs of life x (100 + K) bytes) x 8 / interval;
///               A = M by group, M x (R + peers) x 3 ports without one
/// Five robots by group: 90 + 566 + 24 kbit/s; with keys 122 + 678 + 33.
AirEstimate air_estimate(const Team& team);

}  // namespace trivela::config
