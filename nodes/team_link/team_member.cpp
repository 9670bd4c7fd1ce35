#include "nodes/team_link/team_member.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <memory>
#include <set>

#include "bus/executor.hpp"

namespace trivela::nodes {
namespace {

constexpr std::chrono::milliseconds kPollInterval{200};  // how often the interface is looked at
constexpr std::chrono::seconds kPause{1};                // before it is tried again
constexpr std::chrono::seconds kShortestBackoff{15};
constexpr std::chrono::seconds kLongestBackoff{120};
// Thirty signs of life a second of it, between six machines, were a seventh of all that crosses the air.
constexpr std::chrono::seconds kLease{5};

/// An interface's IPv4 address, such as 172.16.39.3, with the index by which the kernel knows it: "3 172.16.39.3".
/// None: why_without_address() says why.
std::optional<std::string> interface_address(const std::string& interface) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, freeifaddrs);
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (interface != one->ifa_name || one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_UP) == 0 || (one->ifa_flags & IFF_RUNNING) == 0) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* const address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) == nullptr) continue;
    return fmt::format("{} {}", if_nametoindex(one->ifa_name), text.data());
  }
  return std::nullopt;
}

/// "wlan0 is down", "there is no interface wlan0: there are eth0, lo".
std::string why_without_address(const std::string& interface) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return fmt::format("the interfaces cannot be listed: {}", std::strerror(errno));
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, freeifaddrs);
  std::set<std::string> names;
  bool up = true;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    names.insert(one->ifa_name);
    if (interface == one->ifa_name) up = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_RUNNING) != 0;
  }
  if (!names.contains(interface))
    return fmt::format("there is no interface {}: there are {}", interface, fmt::join(names, ", "));
  return up ? fmt::format("{} has no IPv4 address", interface) : fmt::format("{} is down", interface);
}

}  // namespace

TeamMember::TeamMember(const NodeContext& context, bus::DomainConfig domain, std::uint8_t own, bool referee)
    : context_(context),
      domain_(std::move(domain)),
      owner_(fmt::format("team_link/{}", own)),
      listens_to_referee_(referee),
      timeout_(kShortestBackoff),
      thread_([this] { run(); }) {}

TeamMember::~TeamMember() {
  ends_.request();
  thread_.join();
}

/// Where no interface is named, none is looked after: the configuration says all.
std::optional<std::string> TeamMember::address() const {
  const std::string& interface = context_.settings.team_link.interface;
  return interface.empty() ? std::optional<std::string>{""} : interface_address(interface);
}

void TeamMember::note_obstacle(const std::string& obstacle) {
  if (obstacle == obstacle_) return;
  obstacle_ = obstacle;
  if (!obstacle.empty()) context_.logger->warn("not on the team's bus: {}", obstacle);
}

void TeamMember::run() {
  pthread_setname_np(pthread_self(), "team_member");
  while (!ends_.requested()) {
    const auto address = this->address();
    if (!address) {
      note_obstacle(why_without_address(context_.settings.team_link.interface));
      ends_.wait_until(Clock::now() + kPollInterval);
      continue;
    }
    try {
      be_member(*address);
    } catch (const std::exception& error) {
      note_obstacle(error.what());
    }
    if (!ends_.requested()) ends_.wait_until(Clock::now() + kPause);
  }
}

void TeamMember::be_member(const std::string& address) {
  const bus::Participant participant{domain_};
  bus::Node node{participant, "team_bus"};
  bus::WriterOptions as_us;
  as_us.owner = owner_;
  as_us.lease = kLease;
  const auto state = node.writer<msg::TeamState>(as_us);
  std::optional<bus::Output<msg::Referee>> referee;
  if (context_.settings.team_link.base) referee.emplace(node.writer<msg::Referee>(as_us));
  listen(node);
  node.on_device(
      "machine", [this](std::chrono::nanoseconds timeout) { return said_.next(timeout); },
      [&](const TeamMessage& word) {
        if (const auto* const of_us = std::get_if<msg::TeamState>(&word)) return state.write(*of_us);
        if (referee) referee->write(std::get<msg::Referee>(word));
      },
      bus::writes<msg::TeamState, msg::Referee>());
  bus::Stop over;
  node.every(kPollInterval, "interface", [&] { look_after(address, over); });
  last_received_ = Clock::now();
  said_.clear();
  note_obstacle("");
  context_.logger->info("on the team's bus, domain {}{}", domain_.domain_id,
                        address.empty() ? "" : fmt::format(", by {}", address));
  bus::Executor{bus::Executor::kListener, over, {&node}}.run();
}

void TeamMember::listen(bus::Node& node) {
  // Best effort: the next state is worth more than the last, and nobody acknowledges thirty of them ten times a second.
  bus::ReaderOptions newest;
  newest.observer = true;
  node.on<msg::TeamState>(
      [this](const msg::TeamState& state) {
        last_received_ = Clock::now();
        received_.put({state, context_.steady_ns()});
      },
      {}, newest);
  if (listens_to_referee_)
    node.on<msg::Referee>([this](const msg::Referee& word) { received_.put({word, context_.steady_ns()}); });
}

void TeamMember::look_after(const std::string& address, bus::Stop& over) {
  if (ends_.requested()) return over.request();
  const auto now = this->address();
  if (now != address) {
    context_.logger->warn("{} {}: leaves the team's bus", context_.settings.team_link.interface,
                          now ? "has another address, " + *now : "has lost its address");
    return over.request();
  }
  const auto silent = Clock::now() - last_received_.load();
  if (silent < kPollInterval) timeout_ = kShortestBackoff;
  if (silent < timeout_) return;
  context_.logger->info("nothing is received on the team's bus for {} s: joins it again",
                        std::chrono::duration_cast<std::chrono::seconds>(silent).count());
  timeout_ = std::min<Clock::duration>(2 * timeout_, kLongestBackoff);
  over.request();
}

}  // namespace trivela::nodes
