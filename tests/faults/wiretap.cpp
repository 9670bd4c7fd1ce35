#include "tests/faults/wiretap.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace trivela::faults {

Wiretap::Wiretap(const NetworkHost& host) {
  on_host(host, [this] {
    socket_ = ::socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_IP));
    if (socket_ < 0) throw std::runtime_error{fmt::format("a raw socket: {}", std::strerror(errno))};
  });
  const int room = 64 << 20;
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
}

Wiretap::~Wiretap() { ::close(socket_); }

Packets Wiretap::take() {
  constexpr std::size_t kIpHeader = 20, kUdpHeader = 8;
  Packets taken;
  std::array<std::uint8_t, 65536> packet;
  sockaddr_ll from{};
  for (;;) {
    socklen_t length = sizeof from;
    const ssize_t size =
        ::recvfrom(socket_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    if (size <= 0) return taken;
    // On the loopback each packet goes out and comes in.
    const bool udp = static_cast<std::size_t>(size) > kIpHeader + kUdpHeader && packet[9] == IPPROTO_UDP;
    if (from.sll_pkttype != PACKET_OUTGOING && udp)
      taken.emplace_back(packet.begin() + kIpHeader + kUdpHeader, packet.begin() + size);
  }
}

}  // namespace trivela::faults
