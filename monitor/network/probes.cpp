#include "monitor/network/probes.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

namespace trivela::monitor::network {
namespace {

constexpr int kTimeout_ms = 500;
constexpr unsigned kLastPort = 65535;
constexpr char kWord[] = "trivela doctor";  // no RTPS: a participant passes it over

class Socket {
 public:
  explicit Socket(int type) : descriptor_(socket(AF_INET, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  int descriptor() const { return descriptor_; }

  template <class T>
  bool set(int level, int option, const T& value) const {
    return setsockopt(descriptor_, level, option, &value, sizeof value) == 0;
  }
  bool bind_to(const sockaddr_in& address) const {
    return bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

 private:
  int descriptor_;
};

sockaddr_in address_of(in_addr_t address, unsigned port) {
  sockaddr_in made{};
  made.sin_family = AF_INET;
  made.sin_addr.s_addr = address;
  made.sin_port = htons(static_cast<std::uint16_t>(port));
  return made;
}

Probed not_sent() { return {Probe::kNotSent, std::strerror(errno)}; }

// Sends, and waits for that word; others may speak on the port meanwhile.
Probed send_and_hear(const Socket& out, const Socket& in, const sockaddr_in& to) {
  if (sendto(out.descriptor(), kWord, sizeof kWord, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) < 0)
    return errno == EPERM ? Probed{Probe::kLost, "the firewall refuses it"} : not_sent();
  pollfd readable{in.descriptor(), POLLIN, 0};
  for (int i = 0; i < 100 && poll(&readable, 1, kTimeout_ms) > 0; ++i) {
    std::array<char, 64> heard{};
    const ssize_t n = recv(in.descriptor(), heard.data(), heard.size(), 0);
    if (n == sizeof kWord && std::memcmp(heard.data(), kWord, sizeof kWord) == 0) return {Probe::kArrived, {}};
  }
  return {Probe::kLost, {}};
}

}  // namespace

Probed probe_multicast(const std::string& address, const std::string& group, unsigned port) {
  const Socket in{SOCK_DGRAM}, out{SOCK_DGRAM};
  const ip_mreq membership{{inet_addr(group.c_str())}, {inet_addr(address.c_str())}};
  const int shared = 1;
  if (!in.set(SOL_SOCKET, SO_REUSEADDR, shared) || !in.bind_to(address_of(membership.imr_multiaddr.s_addr, port)) ||
      !in.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, membership))
    return not_sent();
  const unsigned char stays = 0, comes_back = 1;
  if (!out.set(IPPROTO_IP, IP_MULTICAST_IF, membership.imr_interface) ||
      !out.set(IPPROTO_IP, IP_MULTICAST_TTL, stays) || !out.set(IPPROTO_IP, IP_MULTICAST_LOOP, comes_back))
    return not_sent();
  return send_and_hear(out, in, address_of(membership.imr_multiaddr.s_addr, port));
}

Probed probe_unicast(const std::string& address, Ports ports) {
  if (ports.last > kLastPort) return {};
  constexpr unsigned kFirstOfParticipants = 10;
  for (unsigned port = ports.first + kFirstOfParticipants; port <= ports.last; ++port) {
    const Socket in{SOCK_DGRAM}, out{SOCK_DGRAM};
    const sockaddr_in self = address_of(inet_addr(address.c_str()), port);
    if (!in.bind_to(self)) {
      if (errno == EADDRINUSE) continue;
      return not_sent();
    }
    return send_and_hear(out, in, self);
  }
  return {Probe::kNotSent, "every port of the domain is in use"};
}

Peer probe_peer(const std::string& name) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  constexpr const char* kDiscard = "9";
  if (getaddrinfo(name.c_str(), kDiscard, &wanted, &found) != 0) return {name, PeerState::kUnknownName};
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owned{found, freeaddrinfo};
  const Socket socket{SOCK_STREAM};
  if (connect(socket.descriptor(), found->ai_addr, found->ai_addrlen) == 0 || errno == ECONNREFUSED)
    return {name, PeerState::kThere};
  if (errno != EINPROGRESS) return {name, PeerState::kSilent};
  pollfd writable{socket.descriptor(), POLLOUT, 0};
  if (poll(&writable, 1, kTimeout_ms) <= 0) return {name, PeerState::kSilent};
  int outcome = 0;
  socklen_t size = sizeof outcome;
  getsockopt(socket.descriptor(), SOL_SOCKET, SO_ERROR, &outcome, &size);
  return {name, outcome == 0 || outcome == ECONNREFUSED ? PeerState::kThere : PeerState::kSilent};
}

std::size_t busy_ports(Ports ports) {
  std::size_t busy = 0;
  for (unsigned port = ports.first; port <= ports.last && port <= kLastPort; ++port) {
    const Socket socket{SOCK_DGRAM};
    if (!socket.bind_to(address_of(htonl(INADDR_ANY), port)) && errno == EADDRINUSE) ++busy;
  }
  return busy;
}

}  // namespace trivela::monitor::network
