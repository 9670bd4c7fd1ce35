#include "monitor/network/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <istream>
#include <regex>
#include <sstream>
#include <utility>

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

Finding ok(std::string value) { return {"", Verdict::kOk, std::move(value), ""}; }
Finding warn(std::string value, std::string advice) {
  return {"", Verdict::kWarn, std::move(value), std::move(advice)};
}
Finding bad(std::string value, std::string advice) { return {"", Verdict::kBad, std::move(value), std::move(advice)}; }

Finding interface_finding(const Readings& readings) {
  const Interface* const one = chosen(readings);
  if (one == nullptr && !readings.wanted_interface.empty()) {
    std::vector<std::string> names;
    for (const Interface& other : readings.interfaces) names.push_back(other.name);
    return bad(fmt::format("there is no {}", readings.wanted_interface),
               fmt::format("name one of {} in the DDS configuration or by --interface", fmt::join(names, ", ")));
  }
  if (one == nullptr)
    return bad("none but loopback is up with an address",
               "connect the robot: ip link set NAME up, and an address by DHCP or ip address add");
  if (!one->up)
    return bad(fmt::format("{} is down", one->name),
               fmt::format("ip link set {} up; plug the cable in or join the wireless network", one->name));
  if (one->addresses.empty())
    return bad(fmt::format("{} has no IPv4 address", one->name),
               fmt::format("ask DHCP, or ip address add ADDRESS/LENGTH dev {}", one->name));
  return ok(fmt::format("{} {}{}", one->name, fmt::join(one->addresses, " "), one->wireless ? ", wireless" : ""));
}

Finding multicast_finding(const Readings& readings) {
  const Interface* const one = chosen(readings);
  if (one == nullptr || !one->up) return warn("not tried", "put the interface right first");
  if (!one->multicast && !one->loopback)
    return bad(fmt::format("{} has no MULTICAST flag", one->name),
               fmt::format("ip link set {} multicast on, or name the peers and AllowMulticast=false", one->name));
  const std::string over = fmt::format("{} over {}", readings.group, one->name);
  switch (readings.multicast) {
    case Probe::kArrived:
      return ok(over + " comes back");
    case Probe::kLost:
      return bad(over + " does not come back",
                 "let UDP to the group pass in the firewall; else name the peers and AllowMulticast=false");
    case Probe::kNotSent:
      return bad(fmt::format("{} cannot be sent: {}", over, readings.probe_error),
                 fmt::format("ip route add 224.0.0.0/4 dev {}", one->name));
    case Probe::kNotTried:
      break;
  }
  return warn("not tried", "name an interface by --interface");
}

Finding unicast_finding(const Readings& readings) {
  const Ports ports = ports_of(readings.domain_id);
  switch (readings.unicast) {
    case Probe::kArrived:
      return ok("a datagram to a port of the domain arrives");
    case Probe::kLost:
      return bad("a datagram to a port of the domain does not arrive",
                 fmt::format("let UDP to ports {} to {} pass in the firewall", ports.first, ports.last));
    case Probe::kNotSent:
      return bad(fmt::format("a datagram cannot be sent: {}", readings.probe_error),
                 "look at addresses and routes: ip address, ip route");
    case Probe::kNotTried:
      break;
  }
  return warn("not tried", "put the interface right first");
}

Finding firewall_finding(const Readings& readings) {
  const Ports ports = ports_of(readings.domain_id);
  if (!readings.ruleset) return ok("rules cannot be read (no nft, or no right to): the probes above stand for them");
  const auto rules = swallowing_rules(*readings.ruleset, ports);
  if (rules.empty()) return ok(fmt::format("no rule swallows UDP to {} to {}", ports.first, ports.last));
  return warn(fmt::format("may swallow UDP to {} to {}: {}", ports.first, ports.last, rules.front()),
              fmt::format("before it, for the team's interface: udp dport {}-{} accept", ports.first, ports.last));
}

Finding buffers_finding(const Readings& readings) {
  const std::string value = fmt::format("net.core.rmem_max {} of {} bytes that Cyclone asks for",
                                        readings.rmem_max_bytes, readings.rmem_wanted_bytes);
  if (readings.rmem_max_bytes >= readings.rmem_wanted_bytes) return ok(value);
  return warn(value, fmt::format("sysctl -w net.core.rmem_max={}", readings.rmem_wanted_bytes));
}

Finding clock_finding(const Readings& readings) {
  if (readings.year < readings.build_year)
    return bad(fmt::format("the year {}, before this program was built", readings.year),
               "set it (date -s) and run chrony: certificates are not valid yet, and logs do not align");
  if (!readings.clock_synchronised)
    return warn("not synchronised",
                "run chrony with the base as its server; without it logs align by what nodes measure");
  return ok("synchronised");
}

Finding domain_finding(const Readings& readings) {
  if (!readings.members && readings.join_error.empty())
    return warn(fmt::format("{}: not joined, since a node that does not receive its own messages cannot leave",
                            readings.domain_id),
                "let its own datagrams in first");
  if (!readings.members)
    return bad(fmt::format("{} cannot be joined: {}", readings.domain_id, readings.join_error),
               "put the DDS configuration right");
  const std::string value = fmt::format("{}: {} participants seen within 1 s, {} of its ports in use here",
                                        readings.domain_id, *readings.members, readings.busy_ports);
  if (*readings.members > 0) return ok(value);
  return warn(value, "start a node on another machine, and look again");
}

Finding ports_finding(const Readings& readings) {
  const Ports ports = ports_of(readings.domain_id);
  const std::string value = fmt::format("{} to {}, ephemeral {} to {}", ports.first, ports.last,
                                        readings.ephemeral_first, readings.ephemeral_last);
  if (ports.last > 65535) return bad(value, "a domain above 232 has no ports: take one of 0 to 100");
  if (ports.first > readings.ephemeral_last || ports.last < readings.ephemeral_first) return ok(value);
  return bad(value + ": any program may be given one of them",
             "take a domain of 0 to 100, or move net.ipv4.ip_local_port_range");
}

Finding own_bus_finding(const Readings& readings) {
  const Ports ports = ports_of(readings.domain_id);
  if (!readings.loopback_alone) return ok(fmt::format("domain {} is not confined to the loopback", readings.domain_id));
  if (!readings.open_ports) return ok("the kernel does not say which sockets receive from other interfaces");
  if (readings.open_ports->empty())
    return ok(fmt::format("no socket of domain {} receives from another interface", readings.domain_id));
  return warn(
      fmt::format("reached from other machines: UDP {}", fmt::join(*readings.open_ports, ", ")),
      fmt::format("a program that is not Trivela's has them open; load config/network/trivela.nft with own = {}-{}",
                  ports.first, ports.last));
}

Finding peer_finding(const Peer& peer) {
  switch (peer.state) {
    case PeerState::kThere:
      return ok("there");
    case PeerState::kUnknownName:
      return bad("no such name", "write its address, or put the name into /etc/hosts");
    case PeerState::kSilent:
      break;
  }
  return bad("silent", "switched on, on this network, in this subnet? Its firewall may drop TCP");
}

Finding realtime_finding(const Readings& readings) {
  constexpr std::uint64_t kEnough_bytes = std::uint64_t{256} << 20;
  const bool locks = readings.memlock_bytes >= kEnough_bytes;
  const std::string value = fmt::format("SCHED_FIFO {}, memory {} be locked",
                                        readings.may_schedule_fifo ? "allowed" : "refused", locks ? "may" : "may not");
  if (readings.may_schedule_fifo && locks) return ok(value);
  return warn(
      value,
      "LimitRTPRIO=90 and LimitMEMLOCK=infinity in the service, or rtprio and memlock in /etc/security/limits.conf");
}

constexpr std::pair<const char*, Finding (*)(const Readings&)> kChecks[] = {
    {"interface", interface_finding}, {"multicast", multicast_finding},     {"own address", unicast_finding},
    {"firewall", firewall_finding},   {"receive buffers", buffers_finding}, {"clock", clock_finding},
    {"ports", ports_finding},         {"domain", domain_finding},           {"own bus", own_bus_finding},
    {"real time", realtime_finding}};

}  // namespace

std::vector<Finding> findings_of(const Readings& readings) {
  std::vector<Finding> all;
  const auto add = [&](std::string check, Finding finding) {
    finding.check = std::move(check);
    all.push_back(std::move(finding));
  };
  for (const auto& [check, find] : kChecks) add(check, find(readings));
  for (const Peer& peer : readings.peers) add(fmt::format("peer {}", peer.name), peer_finding(peer));
  return all;
}

namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// "7400", "7400-7649", "{ 53, 7400-7649 }" after "dport ": whether one of the numbers or ranges touches the ports; with
// `whole` whether one covers them all.
bool names_ports(const std::string& rule, Ports ports, bool whole) {
  static const std::regex kNamed{R"re(dport (\{[^}]*|\S*))re"}, kRange{R"re((\d+)(?:-(\d+))?)re"};
  std::smatch named;
  std::regex_search(rule, named, kNamed);
  for (std::sregex_iterator at{named[1].first, named[1].second, kRange}, end; at != end; ++at) {
    const unsigned long first = std::stoul((*at)[1]), last = (*at)[2].matched ? std::stoul((*at)[2]) : first;
    if (whole ? first <= ports.first && last >= ports.last : first <= ports.last && last >= ports.first) return true;
  }
  return false;
}

// Whether a rule is about all that arrives at the ports, whatever else it asks for.
bool is_about(const std::string& rule, Ports ports) {
  if (has(rule, "tcp ") || has(rule, "icmp") || has(rule, "ct state invalid")) return false;
  return !has(rule, "dport ") || (has(rule, "udp dport ") && names_ports(rule, ports, false));
}

bool accepts(const std::string& rule, Ports ports) {
  return has(rule, "accept") && has(rule, "udp dport ") && names_ports(rule, ports, true);
}

}  // namespace

std::vector<std::string> swallowing_rules(std::string_view ruleset, Ports ports) {
  std::vector<std::string> found;
  std::istringstream lines{std::string{ruleset}};
  bool accepted = false;  // by a rule of this chain before
  std::string policy;     // of this chain, if it drops
  for (std::string rule; std::getline(lines >> std::ws, rule);) {
    if (rule.starts_with("chain ")) {
      accepted = false;
      policy.clear();
    } else if (rule.starts_with("type ")) {
      if (has(rule, "policy drop") && !has(rule, "hook forward")) policy = rule;
    } else if (rule == "}") {
      if (!policy.empty() && !accepted) found.push_back(policy);
      policy.clear();
    } else if (accepts(rule, ports)) {
      accepted = true;
    } else if (!accepted && (has(rule, "drop") || has(rule, "reject")) && is_about(rule, ports)) {
      found.push_back(rule);
    }
  }
  return found;
}

}  // namespace trivela::monitor::network
