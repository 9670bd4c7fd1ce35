#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::monitor::network {

/// An interface of this machine.
struct Interface {
  std::string name;
  std::vector<std::string> addresses;  ///< IPv4
  bool up = false;                     ///< switched on, and something is at the other end
  bool multicast = false;
  bool loopback = false;
  bool wireless = false;
};

/// What became of a datagram that was sent to oneself.
enum class Probe { kArrived, kLost, kNotSent, kNotTried };

/// A machine that should be there.
enum class PeerState { kThere, kSilent, kUnknownName };
struct Peer {
  std::string name;
  PeerState state = PeerState::kSilent;
};

/// Ports of a domain: 250 from 7400 + 250 x domain on (RTPS 9.6.2.1).
struct Ports {
  unsigned first = 7400;
  unsigned last = 7649;
};
constexpr Ports ports_of(unsigned domain_id) { return {7400 + 250 * domain_id, 7400 + 250 * domain_id + 249}; }

/// What was read of this machine and its network: facts, nothing judged.
struct Readings {
  unsigned domain_id = 0;
  std::vector<Interface> interfaces;
  std::string wanted_interface;  ///< by flag or by Cyclone's configuration: name or address; empty: none
  std::string group = "239.255.0.1";
  Probe multicast = Probe::kNotTried;        ///< to the group, over the interface
  Probe unicast = Probe::kNotTried;          ///< to the interface's own address, on a port of the domain
  std::string probe_error;                   ///< why one could not be sent
  std::int64_t rmem_max_bytes = 0;           ///< net.core.rmem_max
  std::int64_t rmem_wanted_bytes = 1 << 20;  ///< what Cyclone asks for
  int year = 0;
  int build_year = 0;
  bool clock_synchronised = false;
  std::optional<std::size_t> members;  ///< of the domain; none: it was not joined
  std::string join_error;              ///< why it could not be; empty: nobody tried
  std::vector<Peer> peers;
  std::size_t busy_ports = 0;   ///< of the domain, on this machine
  bool loopback_alone = false;  ///< the domain's configuration names the loopback and no other interface
  /// Of the domain, where a socket of this machine hears every interface; none: the kernel does not say.
  std::optional<std::set<unsigned>> open_ports;
  unsigned ephemeral_first = 0;  ///< net.ipv4.ip_local_port_range
  unsigned ephemeral_last = 0;
  std::optional<std::string> ruleset;  ///< nft list ruleset; none: there is no nft, or it may not be read
  bool may_schedule_fifo = false;
  std::uint64_t memlock_bytes = 0;
};

/// The interface that is meant: that which is wanted, else the first that is up and no loopback; nullptr: there is
/// none.
const Interface* chosen(const Readings& readings);

enum class Verdict { kOk, kWarn, kBad };

/// One check: what was found, and what to do about it, unless all is well.
struct Finding {
  std::string check;
  Verdict verdict = Verdict::kOk;
  std::string value;
  std::string advice;
};

/// Each check once, always in the same order.
std::vector<Finding> findings_of(const Readings& readings);

/// The rules of a ruleset, as `nft list ruleset` prints it, that may swallow datagrams to these ports.
std::vector<std::string> swallowing_rules(std::string_view ruleset, Ports ports);

}  // namespace trivela::monitor::network
