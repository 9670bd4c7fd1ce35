#include "monitor/network/gather.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timex.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <thread>

#include "bus/census.hpp"
#include "bus/domain/process.hpp"

namespace trivela::monitor::network {
namespace {

Interface& interface_named(std::vector<Interface>& all, const ifaddrs& entry) {
  for (Interface& known : all)
    if (known.name == entry.ifa_name) return known;
  Interface& made = all.emplace_back();
  made.name = entry.ifa_name;
  made.up = (entry.ifa_flags & IFF_UP) != 0 && (entry.ifa_flags & IFF_RUNNING) != 0;
  made.multicast = (entry.ifa_flags & IFF_MULTICAST) != 0;
  made.loopback = (entry.ifa_flags & IFF_LOOPBACK) != 0;
  std::error_code none;
  made.wireless = std::filesystem::exists("/sys/class/net/" + made.name + "/phy80211", none);
  return made;
}

std::vector<Interface> interfaces() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owned{list, freeifaddrs};
  std::vector<Interface> all;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    Interface& one = interface_named(all, *entry);
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr, text.data(), text.size());
    one.addresses.emplace_back(text.data());
  }
  return all;
}

// None: there is no nft, or it refuses.
std::optional<std::string> nft_ruleset() {
  FILE* const pipe = popen("nft list ruleset 2>/dev/null", "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), n);
  return pclose(pipe) == 0 ? std::optional{text} : std::nullopt;
}

bool may_schedule_fifo() {
  bool allowed = false;
  std::thread{[&allowed] {
    const sched_param lowest{1};
    allowed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &lowest) == 0;
  }}.join();
  return allowed;
}

void read_machine(Readings& readings) {
  std::ifstream{"/proc/sys/net/core/rmem_max"} >> readings.rmem_max_bytes;
  std::ifstream{"/proc/sys/net/ipv4/ip_local_port_range"} >> readings.ephemeral_first >> readings.ephemeral_last;
  constexpr int kYearInDate = 7;  // "Nov 23 2026"
  readings.build_year = std::atoi(&__DATE__[kYearInDate]);
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  if (gmtime_r(&now, &date) != nullptr) readings.year = 1900 + date.tm_year;
  timex state{};
  readings.clock_synchronised = adjtimex(&state) != TIME_ERROR && (state.status & STA_UNSYNC) == 0;
  readings.may_schedule_fifo = may_schedule_fifo();
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0) readings.memlock_bytes = limit.rlim_cur;
  if (geteuid() == 0) readings.memlock_bytes = RLIM_INFINITY;
  readings.ruleset = nft_ruleset();
}

void count_members(const bus::DomainConfig& domain, Readings& readings) try {
  const bus::Participant participant{domain};
  bus::CensusTaker taker{participant};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{1};
  for (auto left = end - std::chrono::steady_clock::now(); left > left.zero();
       left = end - std::chrono::steady_clock::now()) {
    if (taker.wait(left)) readings.members = taker.take().members.size();
  }
  readings.members = taker.take().members.size();
} catch (const bus::Error& error) {
  readings.join_error = error.what();
}

std::string configuration_of(const bus::DomainConfig& domain) {
  if (!domain.xml.empty()) return domain.xml;
  const char* const uri = std::getenv("CYCLONEDDS_URI");
  if (uri == nullptr) return {};
  std::string text = uri;
  if (!text.starts_with("file://")) return text;
  std::ifstream in{text.substr(7)};
  return {std::istreambuf_iterator<char>{in}, {}};
}

}  // namespace

std::string interface_of(const std::string& xml) {
  static const std::regex kNamed{R"re(<NetworkInterface\s[^>]*\b(?:name|address)\s*=\s*["']([^"']+)["'])re"};
  static const std::regex kOlder{R"re(<NetworkInterfaceAddress>\s*([^<\s]+))re"};
  std::smatch match;
  if (std::regex_search(xml, match, kNamed) || std::regex_search(xml, match, kOlder)) return match[1];
  return {};
}

Readings gather(const Subject& subject) {
  Readings readings;
  readings.domain_id = subject.domain.domain_id;
  readings.interfaces = interfaces();
  const std::string xml = configuration_of(subject.domain);
  readings.wanted_interface = subject.interface.empty() ? interface_of(xml) : subject.interface;
  // Loopback needs no network: then it is asked how the machine stands to one.
  if (subject.interface.empty() && readings.wanted_interface == "lo") readings.wanted_interface.clear();
  static const std::regex kGroup{R"re(<SPDPMulticastAddress>\s*([0-9.]+))re"};
  if (std::smatch match; std::regex_search(xml, match, kGroup)) readings.group = match[1];
  const Ports ports = ports_of(readings.domain_id);
  readings.busy_ports = busy_ports(ports);
  readings.loopback_alone = bus::loopback_alone(xml);
  readings.open_ports = open_ports(ports);
  const Interface* const one = chosen(readings);
  if (one != nullptr && one->up && !one->addresses.empty()) {
    const Probed multicast = probe_multicast(one->addresses.front(), readings.group, ports.first);
    const Probed unicast = probe_unicast(one->addresses.front(), ports);
    readings.multicast = multicast.probe;
    readings.unicast = unicast.probe;
    readings.probe_error = multicast.error.empty() ? unicast.error : multicast.error;
  }
  read_machine(readings);
  // Cyclone 0.10 ends its threads by a datagram to itself: a participant that cannot hear itself could not leave.
  if (readings.unicast != Probe::kLost) count_members(subject.domain, readings);
  for (const std::string& peer : subject.peers) readings.peers.push_back(probe_peer(peer));
  return readings;
}

}  // namespace trivela::monitor::network
