#include "tests/faults/impostor.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "bus/domain.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/faults/rtps_packet.hpp"

namespace trivela::faults {
namespace {

using std::chrono::seconds;

constexpr std::uint8_t kInfoDestination = 0x0e;
constexpr std::size_t kSubmessageHeader = 4, kGuidPrefix = 12;

/// The pace of what is sent, so that no receive buffer overflows.
void pause(int ms) { poll(nullptr, 0, ms); }

/// The same packet for every participant, whomever it was for.
void address_to_all(std::vector<std::uint8_t>& packet) {
  for (const Submessage& part : submessages_of(packet))
    if (part.id == kInfoDestination && part.end - part.begin >= kSubmessageHeader + kGuidPrefix)
      std::fill_n(packet.begin() + static_cast<std::ptrdiff_t>(part.begin + kSubmessageHeader), kGuidPrefix,
                  std::uint8_t{0});
}

/// Writer and listener as two processes of the attacker's.
void speak(std::uint32_t domain_id, const std::string& tag) {
  bus::DomainConfig own = bus::loopback(domain_id, tag);
  const std::string opening = "<Discovery>";
  own.xml.insert(own.xml.find(opening) + opening.size(),
                 fmt::format("<ExternalDomainId>{}</ExternalDomainId>", domain_id));
  const bus::DomainConfig other{domain_id % 100 + 1, own.xml};
  bus::WriterOptions as_decision;
  as_decision.owner = "kick_decision/1";
  as_decision.strength = 1000;
  const bus::Reader<msg::KickOrder> listener{bus::Participant{own}};
  bus::Writer<msg::KickOrder> writer{bus::Participant{other}, as_decision};
  if (!writer.wait_for_readers(1, seconds{30})) throw std::runtime_error{"the impostor's own listener does not come"};
  for (int i = 0; i < kForgedKicks; ++i) {
    msg::KickOrder order{};
    order.robot_id = 1;
    order.seq = static_cast<std::uint64_t>(i + 1);
    order.t_ns = 1;
    order.kick_id = kForgedKick + i;
    order.power = 0.5;
    order.possession = true;
    writer.write(order);
    pause(20);
  }
}

}  // namespace

Packets forged_orders(const NetworkHost& host, std::uint32_t domain_id, const std::string& tag) {
  Wiretap tap{host};
  on_host(host, [&] { speak(domain_id, tag); });
  Packets packets = tap.take();
  std::ranges::for_each(packets, address_to_all);
  return packets;
}

void send_to_domain(const NetworkHost& host, const std::string& address, std::uint32_t domain_id,
                    const Packets& packets) {
  constexpr int kTimes = 5;
  constexpr std::uint16_t kFirst = 10, kBehindLast = 30;  // of participants 0 to 9, discovery and data
  int sender = -1;
  on_host(host, [&] { sender = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0); });
  sockaddr_in to{};
  to.sin_family = AF_INET;
  inet_pton(AF_INET, address.c_str(), &to.sin_addr);
  for (int time = 0; time < kTimes; ++time)
    for (const auto& packet : packets) {
      for (std::uint16_t port = kFirst; port < kBehindLast; ++port) {
        to.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain_id + port));
        ::sendto(sender, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
      }
      pause(1);
    }
  ::close(sender);
}

}  // namespace trivela::faults
