#include "monitor/network/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::monitor::network {

const Interface* chosen(const Readings& readings) {
  const auto found = std::ranges::find_if(readings.interfaces, [&](const Interface& one) {
    if (readings.wanted_interface.empty()) return one.up && !one.loopback && !one.addresses.empty();
    return one.name == readings.wanted_interface ||
           std::ranges::find(one.addresses, readings.wanted_interface) != one.addresses.end();
  });
  return found == readings.interfaces.end() ? nullptr : &*found;
}

namespace {

Finding interface_finding(const Readings& readings) {
  const std::string check = "interface";
  const Interface* const one = chosen(readings);
  if (one == nullptr && !readings.wanted_interface.empty()) {
    std::vector<std::string> names;
    for (const Interface& other : readings.interfaces) names.push_back(other.name);
    return {check, Verdict::kBad, fmt::format("there is no {}", readings.wanted_interface),
            fmt::format("name one of {} in the DDS configuration or by --interface", fmt::join(names, ", "))};
  }
  if (one == nullptr)
    return {check, Verdict::kBad, "none but loopback is up with an address",
            "connect the robot: ip link set NAME up, and an address by DHCP or ip address add"};
  if (!one->up)
    return {check, Verdict::kBad, fmt::format("{} is down", one->name),
            fmt::format("ip link set {} up; plug the cable in or join the wireless network", one->name)};
  if (one->addresses.empty())
    return {check, Verdict::kBad, fmt::format("{} has no IPv4 address", one->name),
            fmt::format("ask DHCP, or ip address add ADDRESS/LENGTH dev {}", one->name)};
  return {check, Verdict::kOk,
          fmt::format("{} {}{}", one->name, fmt::join(one->addresses, " "), one->wireless ? ", wireless" : ""), ""};
}

Finding multicast_finding(const Readings& readings) {
  const std::string check = "multicast";
  const Interface* const one = chosen(readings);
  if (one == nullptr || !one->up) return {check, Verdict::kWarn, "not tried", "put the interface right first"};
  if (!one->multicast && !one->loopback)
    return {check, Verdict::kBad, fmt::format("{} has no MULTICAST flag", one->name),
            fmt::format("ip link set {} multicast on, or name the peers and AllowMulticast=false", one->name)};
  const std::string over = fmt::format("{} over {}", readings.group, one->name);
  switch (readings.multicast) {
    case Probe::kArrived:
      return {check, Verdict::kOk, over + " comes back", ""};
    case Probe::kLost:
      return {check, Verdict::kBad, over + " does not come back",
              "let UDP to the group pass in the firewall; else name the peers and AllowMulticast=false"};
    case Probe::kNotSent:
      return {check, Verdict::kBad, fmt::format("{} cannot be sent: {}", over, readings.probe_error),
              fmt::format("ip route add 224.0.0.0/4 dev {}", one->name)};
    case Probe::kNotTried:
      break;
  }
  return {check, Verdict::kWarn, "not tried", "name an interface by --interface"};
}

Finding unicast_finding(const Readings& readings) {
  const std::string check = "own address";
  const Ports ports = ports_of(readings.domain_id);
  switch (readings.unicast) {
    case Probe::kArrived:
      return {check, Verdict::kOk, "a datagram to a port of the domain arrives", ""};
    case Probe::kLost:
      return {check, Verdict::kBad, "a datagram to a port of the domain does not arrive",
              fmt::format("let UDP to ports {} to {} pass in the firewall", ports.first, ports.last)};
    case Probe::kNotSent:
      return {check, Verdict::kBad, fmt::format("a datagram cannot be sent: {}", readings.probe_error),
              "look at addresses and routes: ip address, ip route"};
    case Probe::kNotTried:
      break;
  }
  return {check, Verdict::kWarn, "not tried", "put the interface right first"};
}

Finding firewall_finding(const Readings& readings) {
  const std::string check = "firewall";
  const Ports ports = ports_of(readings.domain_id);
  if (!readings.ruleset)
    return {check, Verdict::kOk, "rules cannot be read (no nft, or no right to): the probes above stand for them", ""};
  const auto rules = swallowing_rules(*readings.ruleset, ports);
  if (rules.empty())
    return {check, Verdict::kOk, fmt::format("no rule swallows UDP to {} to {}", ports.first, ports.last), ""};
  return {check, Verdict::kWarn, fmt::format("may swallow UDP to {} to {}: {}", ports.first, ports.last, rules.front()),
          fmt::format("before it, for the team's interface: udp dport {}-{} accept", ports.first, ports.last)};
}

Finding buffers_finding(const Readings& readings) {
  const std::string check = "receive buffers";
  const std::string value = fmt::format("net.core.rmem_max {} of {} bytes that Cyclone asks for",
                                        readings.rmem_max_bytes, readings.rmem_wanted_bytes);
  if (readings.rmem_max_bytes >= readings.rmem_wanted_bytes) return {check, Verdict::kOk, value, ""};
  return {check, Verdict::kWarn, value, fmt::format("sysctl -w net.core.rmem_max={}", readings.rmem_wanted_bytes)};
}

Finding clock_finding(const Readings& readings) {
  const std::string check = "clock";
  if (readings.year < readings.build_year)
    return {check, Verdict::kBad, fmt::format("the year {}, before this program was built", readings.year),
            "set it (date -s) and run chrony: certificates are not valid yet, and logs do not align"};
  if (!readings.clock_synchronised)
    return {check, Verdict::kWarn, "not synchronised",
            "run chrony with the base as its server; without it logs align by what nodes measure"};
  return {check, Verdict::kOk, "synchronised", ""};
}

Finding domain_finding(const Readings& readings) {
  const std::string check = "domain";
  if (!readings.members && readings.join_error.empty())
    return {check, Verdict::kWarn,
            fmt::format("{}: not joined, since a node that does not receive its own messages cannot leave",
                        readings.domain_id),
            "let its own datagrams in first"};
  if (!readings.members)
    return {check, Verdict::kBad, fmt::format("{} cannot be joined: {}", readings.domain_id, readings.join_error),
            "put the DDS configuration right"};
  const std::string value = fmt::format("{}: {} participants seen within 1 s, {} of its ports in use here",
                                        readings.domain_id, *readings.members, readings.busy_ports);
  if (*readings.members > 0) return {check, Verdict::kOk, value, ""};
  return {check, Verdict::kWarn, value, "start a node on another machine, and look again"};
}

Finding ports_finding(const Readings& readings) {
  const std::string check = "ports";
  const Ports ports = ports_of(readings.domain_id);
  const std::string value = fmt::format("{} to {}, ephemeral {} to {}", ports.first, ports.last,
                                        readings.ephemeral_first, readings.ephemeral_last);
  if (ports.last > 65535) return {check, Verdict::kBad, value, "a domain above 232 has no ports: take one of 0 to 100"};
  if (ports.first > readings.ephemeral_last || ports.last < readings.ephemeral_first)
    return {check, Verdict::kOk, value, ""};
  return {check, Verdict::kBad, value + ": any program may be given one of them",
          "take a domain of 0 to 100, or move net.ipv4.ip_local_port_range"};
}

Finding own_bus_finding(const Readings& readings) {
  const std::string check = "own bus";
  const Ports ports = ports_of(readings.domain_id);
  if (!readings.loopback_alone)
    return {check, Verdict::kOk, fmt::format("domain {} is not confined to the loopback", readings.domain_id), ""};
  if (!readings.open_ports)
    return {check, Verdict::kOk, "the kernel does not say which sockets receive from other interfaces", ""};
  if (readings.open_ports->empty())
    return {check, Verdict::kOk,
            fmt::format("no socket of domain {} receives from another interface", readings.domain_id), ""};
  return {check, Verdict::kWarn,
          fmt::format("reached from other machines: UDP {}", fmt::join(*readings.open_ports, ", ")),
          fmt::format("a program that is not Trivela's has them open; load config/network/trivela.nft with own = {}-{}",
                      ports.first, ports.last)};
}

Finding peer_finding(const Peer& peer) {
  const std::string check = fmt::format("peer {}", peer.name);
  switch (peer.state) {
    case PeerState::kThere:
      return {check, Verdict::kOk, "there", ""};
    case PeerState::kUnknownName:
      return {check, Verdict::kBad, "no such name", "write its address, or put the name into /etc/hosts"};
    case PeerState::kSilent:
      break;
  }
  return {check, Verdict::kBad, "silent", "switched on, on this network, in this subnet? Its firewall may drop TCP"};
}

Finding realtime_finding(const Readings& readings) {
  const std::string check = "real time";
  constexpr std::uint64_t kEnough_bytes = std::uint64_t{256} << 20;
  const bool locks = readings.memlock_bytes >= kEnough_bytes;
  const std::string value = fmt::format("SCHED_FIFO {}, memory {} be locked",
                                        readings.may_schedule_fifo ? "allowed" : "refused", locks ? "may" : "may not");
  if (readings.may_schedule_fifo && locks) return {check, Verdict::kOk, value, ""};
  return {
      check, Verdict::kWarn, value,
      "LimitRTPRIO=90 and LimitMEMLOCK=infinity in the service, or rtprio and memlock in /etc/security/limits.conf"};
}

}  // namespace

std::vector<Finding> findings_of(const Readings& readings) {
  std::vector<Finding> all{interface_finding(readings), multicast_finding(readings), unicast_finding(readings),
                           firewall_finding(readings),  buffers_finding(readings),   clock_finding(readings),
                           ports_finding(readings),     domain_finding(readings),    own_bus_finding(readings),
                           realtime_finding(readings)};
  for (const Peer& peer : readings.peers) all.push_back(peer_finding(peer));
  return all;
}

}  // namespace trivela::monitor::network
