#include "tests/faults/air_flood.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <utility>

#include "tests/faults/rtps_packet.hpp"

namespace trivela::faults {
namespace {

constexpr std::size_t kGuidPrefix = 8;  // in an RTPS header, 12 bytes

bool announces(const std::vector<std::uint8_t>& packet) {
  const auto parts = submessages_of(packet);
  return packet.size() > 200 && std::ranges::any_of(parts, &Submessage::discovery);
}

constexpr std::array<std::uint8_t, 8> kForEver{0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0xff};  // Duration_t

/// Where the lease stands in the announcement of a participant: behind PID_PARTICIPANT_LEASE_DURATION and its length,
/// in a list of parameters that is little endian.
std::optional<std::size_t> lease_of(const std::vector<std::uint8_t>& packet) {
  constexpr std::array<std::uint8_t, 4> kLease{0x02, 0x00, 0x08, 0x00};
  const auto at = std::search(packet.begin() + kRtpsHeader, packet.end(), kLease.begin(), kLease.end());
  if (packet.end() - at < static_cast<std::ptrdiff_t>(kLease.size() + kForEver.size())) return std::nullopt;
  return static_cast<std::size_t>(at - packet.begin()) + kLease.size();
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
                   std::uint16_t participants, Packets overheard, std::uint64_t seed, Kind kind)
    : targets_(std::move(targets)), overheard_(std::move(overheard)), kind_(kind), random_(seed) {
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

void AirFlood::scramble(std::vector<std::uint8_t>& packet, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < std::min(to, packet.size()); ++i) packet[i] = static_cast<std::uint8_t>(random_());
}

// The announcement of a participant that is not there.
std::vector<std::uint8_t> AirFlood::unknown_participant() {
  const auto fits = [&](const auto& packet) {
    return kind_ == kUndying ? lease_of(packet).has_value() : announces(packet);
  };
  std::vector<std::uint8_t> packet = any();
  for (int tries = 0; !fits(packet) && tries < 100; ++tries) packet = any();
  const std::vector<std::uint8_t> before(packet.begin() + kGuidPrefix, packet.begin() + kRtpsHeader);
  scramble(packet, kGuidPrefix, kRtpsHeader);
  // The same participant inside, where the announcement names itself.
  const std::vector<std::uint8_t> prefix(packet.begin() + kGuidPrefix, packet.begin() + kRtpsHeader);
  for (auto at = packet.begin() + kRtpsHeader;;) {
    at = std::search(at, packet.end(), before.begin(), before.end());
    if (at == packet.end()) break;
    at = std::copy(prefix.begin(), prefix.end(), at);
  }
  if (const auto lease = lease_of(packet); kind_ == kUndying && lease)
    std::ranges::copy(kForEver, packet.begin() + static_cast<std::ptrdiff_t>(*lease));
  return packet;
}

std::vector<std::uint8_t> AirFlood::next() {
  if (kind_ == kUndying) return unknown_participant();
  std::vector<std::uint8_t> packet = any();
  switch (turn_++ % 4) {
    case 0:
      return packet;  // said again
    case 1:
      for (std::size_t flips = 1 + random_() % 4; flips > 0; --flips)
        packet[random_() % packet.size()] ^= static_cast<std::uint8_t>(1u << random_() % 8);
      return packet;
    case 2:
      packet.resize(64 + random_() % 1300);
      scramble(packet, kRtpsHeader, packet.size());
      return packet;
    default:
      return unknown_participant();
  }
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
