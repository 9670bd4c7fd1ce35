#include "tests/faults/impostor.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "bus/domain/domain.hpp"
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

/// Two processes of the attacker's own on a domain: who writes, and who listens so that it is sent at all.
struct TwoProcesses {
  TwoProcesses(std::uint32_t domain_id, const std::string& tag) : listener(bus::loopback(domain_id, tag)) {
    const std::string opening = "<Discovery>";
    listener.xml.insert(listener.xml.find(opening) + opening.size(),
                        fmt::format("<ExternalDomainId>{}</ExternalDomainId>", domain_id));
    writer = {domain_id % 100 + 1, listener.xml};
  }
  bus::DomainConfig listener, writer;
};

/// Orders of one that calls itself the decision of robot 1.
void speak(std::uint32_t domain_id, const std::string& tag) {
  const auto [own, other] = TwoProcesses{domain_id, tag};
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

/// A few states of another life of the robot's.
void speak_of(std::uint8_t robot_id) {
  const auto [own, other] = TwoProcesses{1, "impostor"};
  bus::ReaderOptions best_effort;
  best_effort.observer = true;
  const bus::Reader<msg::TeamState> listener{bus::Participant{own}, best_effort};
  bus::Writer<msg::TeamState> writer{bus::Participant{other}};
  const auto received = [&] { return listener.writers() > 0; };
  for (int i = 0; i < 3000 && !received(); ++i) pause(10);
  if (!received()) throw std::runtime_error{"the impostor's own listener does not come"};
  for (int i = 0; i < 50; ++i) {
    msg::TeamState state{};
    state.robot_id = robot_id;
    state.started_t_ns = kForgedKick;
    writer.write(state);
    pause(20);
  }
}

/// The last data of a user's writer that is in clear, and where it begins; empty: there is none.
std::pair<std::vector<std::uint8_t>, std::size_t> last_word(const Packets& packets) {
  constexpr std::uint8_t kData = 0x15;
  for (auto packet = packets.rbegin(); packet != packets.rend(); ++packet)
    for (const Submessage& part : submessages_of(*packet))
      if (part.id == kData && !part.discovery) return {*packet, part.begin};
  return {};
}

}  // namespace

std::set<Prefix> speakers(const Packets& overheard) {
  constexpr std::size_t kPrefixAt = 8;
  std::set<Prefix> names;
  for (const auto& packet : overheard) {
    if (submessages_of(packet).empty()) continue;
    Prefix name;
    std::copy_n(packet.begin() + kPrefixAt, kGuidPrefix, name.begin());
    names.insert(name);
  }
  return names;
}

Packets forged_states(const NetworkHost& host, std::uint8_t robot_id, const std::set<Prefix>& names) {
  constexpr std::uint8_t kFirstWriters = 64;
  constexpr std::size_t kPrefixAt = 8, kWriterId = 12, kNumber = 20;  // of the message; of the data's submessage
  Wiretap tap{host};
  on_host(host, [&] { speak_of(robot_id); });
  const auto [word, data] = last_word(tap.take());
  if (word.empty()) throw std::runtime_error{"the impostor's own words were not to be heard"};
  Packets packets;
  for (const Prefix& name : names)
    for (std::uint8_t writer = 0; writer < kFirstWriters; ++writer) {
      auto packet = word;
      std::ranges::copy(name, packet.begin() + kPrefixAt);
      const auto at = packet.begin() + static_cast<std::ptrdiff_t>(data);
      at[kWriterId] = at[kWriterId + 1] = 0;
      at[kWriterId + 2] = writer;  // the kind of a writer with keys stays
      at[kNumber + 2] = 0x10;      // a million later
      address_to_all(packet);
      packets.push_back(std::move(packet));
    }
  return packets;
}

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
