#include "tests/faults/air_flood.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "tests/faults/rtps_packet.hpp"

namespace trivela::faults {
namespace {

constexpr std::size_t kGuidPrefix = 8;  // in an RTPS header, 12 bytes

bool announces(const std::vector<std::uint8_t>& packet) {
  const auto parts = submessages_of(packet);
  return packet.size() > 200 && std::ranges::any_of(parts, &Submessage::discovery);
}

sockaddr_in address_of(const std::string& address, std::uint16_t port) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  return to;
}

}  // namespace

std::int64_t resident_bytes(int pid) {
  std::ifstream statm(fmt::format("/proc/{}/statm", pid));
  std::int64_t pages = 0, resident = 0;
  return statm >> pages >> resident ? resident * sysconf(_SC_PAGESIZE) : 0;
}

void keep_packets(const std::filesystem::path& file, const std::string& heading, const Packets& packets) {
  std::ofstream out{file};
  out << heading << '\n';
  for (const auto& packet : packets) out << fmt::format("{:02x}\n", fmt::join(packet, ""));
}

AirFlood::AirFlood(const NetworkHost& host, std::vector<std::string> targets, std::uint32_t domain_id,
                   std::uint16_t participants, Packets overheard, std::uint64_t seed)
    : targets_(std::move(targets)), overheard_(std::move(overheard)), random_(seed) {
  constexpr std::uint16_t kFirst = 7400, kOfDomain = 250, kOfParticipants = 10;  // RTPS 9.6.2.1
  const auto first = static_cast<std::uint16_t>(kFirst + kOfDomain * domain_id);
  ports_ = {first, static_cast<std::uint16_t>(first + 1)};
  for (std::uint16_t port = 0; port < 2 * participants; ++port)
    ports_.push_back(static_cast<std::uint16_t>(first + kOfParticipants + port));
  thread_ = std::thread{[this, network = host.network()] {
    if (setns(network, CLONE_NEWNET) != 0) return;
    socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    run();
    close(socket_);
  }};
}

AirFlood::~AirFlood() {
  stop_ = true;
  thread_.join();
}

Packets AirFlood::last() const {
  const std::lock_guard lock{mutex_};
  return {last_.begin(), last_.end()};
}

std::vector<std::uint8_t> AirFlood::next() {
  const auto any = [&] { return overheard_[random_() % overheard_.size()]; };
  std::vector<std::uint8_t> packet = any();
  const auto scramble = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, packet.size()); ++i) packet[i] = static_cast<std::uint8_t>(random_());
  };
  switch (turn_++ % 4) {
    case 0:
      break;  // said again
    case 1:
      for (std::size_t flips = 1 + random_() % 4; flips > 0; --flips)
        packet[random_() % packet.size()] ^= static_cast<std::uint8_t>(1u << random_() % 8);
      break;
    case 2:
      packet.resize(64 + random_() % 1300);
      scramble(kRtpsHeader, packet.size());
      break;
    default:
      for (int tries = 0; !announces(packet) && tries < 100; ++tries) packet = any();
      const std::vector<std::uint8_t> before(packet.begin() + kGuidPrefix, packet.begin() + kRtpsHeader);
      scramble(kGuidPrefix, kRtpsHeader);
      // The same stranger inside, where the announcement names itself.
      const std::vector<std::uint8_t> stranger(packet.begin() + kGuidPrefix, packet.begin() + kRtpsHeader);
      for (auto at = packet.begin() + kRtpsHeader;;) {
        at = std::search(at, packet.end(), before.begin(), before.end());
        if (at == packet.end()) break;
        at = std::copy(stranger.begin(), stranger.end(), at);
      }
  }
  return packet;
}

void AirFlood::run() {
  while (!stop_) {
    const std::vector<std::uint8_t> packet = next();
    {
      const std::lock_guard lock{mutex_};
      last_.push_back(packet);
      if (last_.size() > kRemembered) last_.pop_front();
    }
    for (const std::string& target : targets_)
      for (const std::uint16_t port : ports_) {
        const sockaddr_in to = address_of(target, port);
        if (sendto(socket_, packet.data(), packet.size(), MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&to),
                   sizeof to) > 0)
          ++sent_;
      }
    std::this_thread::yield();
  }
}

}  // namespace trivela::faults
