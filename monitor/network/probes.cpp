#include <arpa/inet.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "monitor/network/gather.hpp"

namespace trivela::monitor::network {
namespace {

constexpr int kTimeout_ms = 500;
constexpr unsigned kLastPort = 65535;
constexpr char kWord[] = "trivela doctor";  // no RTPS: a participant passes it over

class Socket {
 public:
  explicit Socket(int type) : Socket(AF_INET, type | SOCK_NONBLOCK, 0) {}
  Socket(int family, int type, int protocol) : descriptor_(socket(family, type | SOCK_CLOEXEC, protocol)) {}
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
Probed send_and_receive(const Socket& out, const Socket& in, const sockaddr_in& to) {
  if (sendto(out.descriptor(), kWord, sizeof kWord, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to) < 0)
    return errno == EPERM ? Probed{Probe::kLost, "the firewall refuses it"} : not_sent();
  pollfd readable{in.descriptor(), POLLIN, 0};
  for (int i = 0; i < 100 && poll(&readable, 1, kTimeout_ms) > 0; ++i) {
    std::array<char, 64> received{};
    const ssize_t n = recv(in.descriptor(), received.data(), received.size(), 0);
    if (n == sizeof kWord && std::memcmp(received.data(), kWord, sizeof kWord) == 0) return {Probe::kArrived, {}};
  }
  return {Probe::kLost, {}};
}

// Asks the kernel for every UDP socket of IPv4.
bool ask_for_udp(const Socket& kernel) {
  struct {
    nlmsghdr header;
    inet_diag_req_v2 wanted;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
  request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
  request.wanted.sdiag_family = AF_INET;
  request.wanted.sdiag_protocol = IPPROTO_UDP;
  request.wanted.idiag_states = ~0u;
  const timeval timeout{.tv_sec = 1, .tv_usec = 0};
  return kernel.set(SOL_SOCKET, SO_RCVTIMEO, timeout) &&
         send(kernel.descriptor(), &request, sizeof request, 0) == static_cast<ssize_t>(sizeof request);
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
  return send_and_receive(out, in, address_of(membership.imr_multiaddr.s_addr, port));
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
    return send_and_receive(out, in, self);
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

std::optional<std::set<unsigned>> open_ports(Ports ports) {
  const Socket kernel{AF_NETLINK, SOCK_RAW, NETLINK_SOCK_DIAG};
  if (!ask_for_udp(kernel)) return std::nullopt;
  std::set<unsigned> found;
  alignas(nlmsghdr) std::array<char, 32768> answer{};
  for (;;) {
    const ssize_t size = recv(kernel.descriptor(), answer.data(), answer.size(), 0);
    if (size <= 0) return std::nullopt;
    auto left = static_cast<unsigned>(size);
    for (auto* part = reinterpret_cast<nlmsghdr*>(answer.data()); NLMSG_OK(part, left); part = NLMSG_NEXT(part, left)) {
      if (part->nlmsg_type == NLMSG_DONE) return found;
      if (part->nlmsg_type == NLMSG_ERROR) return std::nullopt;
      const auto& id = static_cast<const inet_diag_msg*>(NLMSG_DATA(part))->id;
      const unsigned port = ntohs(id.idiag_sport);
      if (port >= ports.first && port <= ports.last && id.idiag_src[0] == 0 && id.idiag_if == 0) found.insert(port);
    }
  }
}

}  // namespace trivela::monitor::network
