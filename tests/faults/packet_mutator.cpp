#include "tests/faults/packet_mutator.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tests/faults/rtps_packet.hpp"

namespace trivela::faults {
namespace {

constexpr std::size_t kLongestFrame = 65536;
constexpr std::size_t kUdpHeader = 8;
constexpr std::uint8_t kUdp = 17;

int checked(int result, const char* what) {
  if (result < 0) throw std::runtime_error{fmt::format("{}: {}", what, std::strerror(errno))};
  return result;
}

std::uint16_t port_at(const std::uint8_t* bytes) { return static_cast<std::uint16_t>(256u * bytes[0] + bytes[1]); }

}  // namespace

PacketMutator::PacketMutator(const Mutations& mutations) : mutations_(mutations), random_(mutations.seed) {
  tap_ = checked(socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP)), "a raw socket");
  sockaddr_ll where{};
  where.sll_family = AF_PACKET;
  where.sll_protocol = htons(ETH_P_IP);
  where.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
  checked(bind(tap_, reinterpret_cast<const sockaddr*>(&where), sizeof where), "a raw socket on lo");
  out_ = checked(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "a socket");
  sockaddr_in self{};
  self.sin_family = AF_INET;
  self.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  checked(bind(out_, reinterpret_cast<const sockaddr*>(&self), sizeof self), "a port");
  socklen_t length = sizeof self;
  checked(getsockname(out_, reinterpret_cast<sockaddr*>(&self), &length), "a port");
  own_port_ = ntohs(self.sin_port);
  stop_ = checked(eventfd(0, EFD_CLOEXEC), "an event");
  thread_ = std::thread{[this] { run(); }};
}

void PacketMutator::stop() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(stop_, &one, sizeof one);
  thread_.join();
  for (const int descriptor : {tap_, out_, stop_}) close(descriptor);
}

void PacketMutator::run() {
  std::vector<std::uint8_t> frame(kLongestFrame);
  std::array<pollfd, 2> sources{pollfd{tap_, POLLIN, 0}, pollfd{stop_, POLLIN, 0}};
  for (;;) {
    poll(sources.data(), sources.size(), -1);
    if (sources[1].revents != 0) return;
    sockaddr_ll from{};
    socklen_t length = sizeof from;
    const ssize_t n = recvfrom(tap_, frame.data(), frame.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    // The loopback shows each packet twice: on its way out, and as it comes in.
    if (n <= 0 || from.sll_pkttype != PACKET_HOST) continue;
    take({frame.data(), static_cast<std::size_t>(n)});
  }
}

void PacketMutator::take(std::span<std::uint8_t> frame) {
  if (frame.size() < 20 || frame[9] != kUdp) return;
  const std::size_t ip_header = 4u * (frame[0] & 0x0fu);
  if (frame.size() < ip_header + kUdpHeader) return;
  const std::uint16_t from = port_at(frame.data() + ip_header);
  const std::uint16_t to = port_at(frame.data() + ip_header + 2);
  const auto packet = frame.subspan(ip_header + kUdpHeader);
  if (from == own_port_ || packet.size() < kRtpsHeader || std::memcmp(packet.data(), "RTPS", 4) != 0) return;
  ++seen_;
  if (std::uniform_real_distribution<double>{}(random_) >= mutations_.share || !mutate(packet)) return;
  sockaddr_in there{};
  there.sin_family = AF_INET;
  std::memcpy(&there.sin_addr.s_addr, frame.data() + 16, sizeof there.sin_addr.s_addr);
  there.sin_port = htons(to);
  if (sendto(out_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&there), sizeof there) >= 0)
    ++sent_;
}

bool PacketMutator::wanted(const Submessage& part) const {
  const auto& only = mutations_.only;
  if (!only.empty() && std::find(only.begin(), only.end(), part.id) == only.end()) return false;
  return part.discovery ? mutations_.discovery : mutations_.user_data;
}

bool PacketMutator::mutate(std::span<std::uint8_t> packet) {
  // Where bits may be turned over; without a wish anywhere.
  std::size_t begin = 0;
  std::size_t end = packet.size();
  const bool anywhere = mutations_.only.empty() && mutations_.discovery && mutations_.user_data;
  if (!anywhere) {
    auto parts = submessages_of(packet);
    std::erase_if(parts, [this](const Submessage& part) { return !wanted(part); });
    if (parts.empty()) return false;
    const Submessage& part = parts[random_() % parts.size()];
    begin = part.begin + mutations_.from;
    end = part.begin + std::min(part.end - part.begin, mutations_.to);
  }
  if (begin >= end) return false;
  for (auto flips = 1 + random_() % mutations_.most_flips; flips > 0; --flips)
    packet[begin + random_() % (end - begin)] ^= static_cast<std::uint8_t>(1u << random_() % 8);
  return true;
}

}  // namespace trivela::faults
