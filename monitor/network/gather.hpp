#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/domain/domain.hpp"
#include "monitor/network/findings.hpp"

namespace trivela::monitor::network {

/// What `gather` looks at.
struct Subject {
  bus::DomainConfig domain;
  std::string interface;  ///< name or address; empty: what the DDS configuration names, unless that is loopback
  std::vector<std::string> peers;
};

/// The first interface that a Cyclone configuration names, by name or address; empty: none.
std::string interface_of(const std::string& xml);

/// Reads this machine and its network, in 2 s and half a second a silent peer. Writes to no topic.
Readings gather(const Subject& subject);

struct Probed {
  Probe probe = Probe::kNotTried;
  std::string error;
};

/// Sends a datagram to the group over the interface with this address and listens for it. It leaves the machine never
/// (TTL 0). The port is the domain's for discovery, which participants share.
Probed probe_multicast(const std::string& address, const std::string& group, unsigned port);

/// Sends a datagram to one of this machine's addresses, on a port of the domain that is free.
Probed probe_unicast(const std::string& address, Ports ports);

/// Whether a machine answers to an attempt to connect, even by a refusal, within half a second.
Peer probe_peer(const std::string& name);

/// How many ports of the domain are in use on this machine.
std::size_t busy_ports(Ports ports);

/// Those of these ports on which a UDP socket of this machine hears every interface: bound to no address (0.0.0.0) and
/// to no interface. None: the kernel does not say (sock_diag).
std::optional<std::set<unsigned>> open_ports(Ports ports);

}  // namespace trivela::monitor::network
