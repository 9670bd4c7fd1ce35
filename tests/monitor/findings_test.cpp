#include "monitor/network/findings.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

#include "monitor/network/gather.hpp"

namespace trivela::monitor::network {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A machine on which all is well.
Readings healthy() {
  Readings readings;
  readings.domain_id = 1;
  readings.interfaces = {{"lo", {"127.0.0.1"}, true, false, true, false},
                         {"wlan0", {"172.16.39.3"}, true, true, false, true}};
  readings.multicast = readings.unicast = Probe::kArrived;
  readings.rmem_max_bytes = 4 << 20;
  readings.year = readings.build_year = 2026;
  readings.clock_synchronised = true;
  readings.members = 5;
  readings.ephemeral_first = 32768;
  readings.ephemeral_last = 60999;
  readings.ruleset = "";
  readings.may_schedule_fifo = true;
  readings.memlock_bytes = std::uint64_t{1} << 40;
  return readings;
}

Finding finding(const Readings& readings, const std::string& check) {
  const auto all = findings_of(readings);
  const auto found = std::ranges::find(all, check, &Finding::check);
  return found == all.end() ? Finding{"no " + check, Verdict::kOk, "", ""} : *found;
}

void expect(const Readings& readings, const std::string& check, Verdict verdict, const std::string& value) {
  const Finding found = finding(readings, check);
  EXPECT_EQ(found.verdict, verdict) << found.check << ": " << found.value;
  EXPECT_THAT(found.value, HasSubstr(value));
  EXPECT_EQ(found.advice.empty(), verdict == Verdict::kOk)
      << "whoever is told that something is wrong is told what to do";
}

TEST(NetworkFindings, AreAllWellOnAHealthyMachine) {
  for (const Finding& one : findings_of(healthy())) {
    EXPECT_EQ(one.verdict, Verdict::kOk) << one.check << ": " << one.value;
    EXPECT_THAT(one.advice, IsEmpty());
  }
  expect(healthy(), "interface", Verdict::kOk, "wlan0 172.16.39.3, wireless");
}

TEST(NetworkFindings, NameAnInterfaceThatIsNotThere) {
  Readings readings = healthy();
  readings.wanted_interface = "wlan1";
  expect(readings, "interface", Verdict::kBad, "there is no wlan1");
  EXPECT_THAT(finding(readings, "interface").advice, HasSubstr("lo, wlan0"));
  expect(readings, "multicast", Verdict::kWarn, "not tried");
  readings.wanted_interface = "172.16.39.3";
  expect(readings, "interface", Verdict::kOk, "wlan0");
}

TEST(NetworkFindings, SeeThatAnInterfaceIsDownOrHasNoAddress) {
  Readings readings = healthy();
  readings.wanted_interface = "wlan0";
  readings.interfaces[1].addresses.clear();
  expect(readings, "interface", Verdict::kBad, "wlan0 has no IPv4 address");
  readings.interfaces[1].up = false;
  expect(readings, "interface", Verdict::kBad, "wlan0 is down");
  expect(readings, "multicast", Verdict::kWarn, "not tried");
  readings.wanted_interface.clear();
  expect(readings, "interface", Verdict::kBad, "none but loopback");
}

TEST(NetworkFindings, NameThePortsOfAnOwnBusThatOtherMachinesReach) {
  Readings readings = healthy();
  readings.domain_id = 42;
  readings.open_ports = {17910, 17911};
  expect(readings, "own bus", Verdict::kOk, "domain 42 is not confined to the loopback");
  readings.loopback_alone = true;
  expect(readings, "own bus", Verdict::kWarn, "UDP 17910, 17911");
  EXPECT_THAT(finding(readings, "own bus").advice, HasSubstr("own = 17900-18149"));
  readings.open_ports = std::set<unsigned>{};
  expect(readings, "own bus", Verdict::kOk, "no socket of domain 42");
  readings.open_ports.reset();
  expect(readings, "own bus", Verdict::kOk, "does not say");
}

TEST(OpenPorts, AreThoseOfSocketsThatHearEveryInterface) {
  constexpr unsigned kFirst = 32500;
  const Ports ports{kFirst, kFirst + 9};
  const auto bound = [](unsigned port, std::uint32_t address, bool to_loopback) {
    const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (to_loopback) {
      EXPECT_EQ(setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, "lo", 2), 0);
    }
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(static_cast<std::uint16_t>(port));
    own.sin_addr.s_addr = htonl(address);
    EXPECT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&own), sizeof own), 0);
    return descriptor;
  };
  const int sockets[] = {bound(kFirst, INADDR_ANY, false), bound(kFirst + 1, INADDR_ANY, true),
                         bound(kFirst + 2, INADDR_LOOPBACK, false)};
  const auto open = open_ports(ports);
  for (const int descriptor : sockets) close(descriptor);
  if (!open) GTEST_SKIP() << "the kernel does not say";
  EXPECT_THAT(*open, ElementsAre(kFirst));
}

TEST(NetworkFindings, SeeWhatBecomesOfMulticast) {
  Readings readings = healthy();
  readings.multicast = Probe::kLost;
  expect(readings, "multicast", Verdict::kBad, "does not come back");
  readings.multicast = Probe::kNotSent;
  readings.probe_error = "Network is unreachable";
  expect(readings, "multicast", Verdict::kBad, "Network is unreachable");
  readings.multicast = Probe::kNotTried;
  expect(readings, "multicast", Verdict::kWarn, "not tried");
  readings.interfaces[1].multicast = false;
  expect(readings, "multicast", Verdict::kBad, "wlan0 has no MULTICAST flag");
}

TEST(NetworkFindings, SeeWhatBecomesOfADatagramToOneself) {
  Readings readings = healthy();
  readings.unicast = Probe::kLost;
  expect(readings, "own address", Verdict::kBad, "does not arrive");
  EXPECT_THAT(finding(readings, "own address").advice, HasSubstr("7650 to 7899"));
  readings.unicast = Probe::kNotSent;
  expect(readings, "own address", Verdict::kBad, "cannot be sent");
  readings.unicast = Probe::kNotTried;
  expect(readings, "own address", Verdict::kWarn, "not tried");
}

TEST(NetworkFindings, KnowBuffersClockAndRights) {
  Readings readings = healthy();
  readings.rmem_max_bytes = 212992;
  expect(readings, "receive buffers", Verdict::kWarn, "212992 of 1048576");
  readings.clock_synchronised = false;
  expect(readings, "clock", Verdict::kWarn, "not synchronised");
  readings.year = 1970;
  expect(readings, "clock", Verdict::kBad, "1970");
  readings.may_schedule_fifo = false;
  expect(readings, "real time", Verdict::kWarn, "SCHED_FIFO refused");
  readings.may_schedule_fifo = true;
  readings.memlock_bytes = 8 << 20;
  expect(readings, "real time", Verdict::kWarn, "may not be locked");
}

TEST(NetworkFindings, KnowWhichDomainsCollideWithEphemeralPorts) {
  Readings readings = healthy();
  readings.domain_id = 100;
  expect(readings, "ports", Verdict::kOk, "32400 to 32649");
  readings.domain_id = 102;
  expect(readings, "ports", Verdict::kBad, "32900 to 33149");
  readings.domain_id = 101;
  expect(readings, "ports", Verdict::kBad, "32650 to 32899");
  readings.domain_id = 233;
  expect(readings, "ports", Verdict::kBad, "65650");
}

TEST(NetworkFindings, KnowWhoIsThere) {
  Readings readings = healthy();
  readings.members = 0;
  expect(readings, "domain", Verdict::kWarn, "0 participants");
  readings.members.reset();
  expect(readings, "domain", Verdict::kWarn, "not joined");
  readings.join_error = "no free port";
  expect(readings, "domain", Verdict::kBad, "no free port");
  readings.peers = {{"robot2", PeerState::kThere}, {"robot3", PeerState::kSilent}, {"robot9", PeerState::kUnknownName}};
  expect(readings, "peer robot2", Verdict::kOk, "there");
  expect(readings, "peer robot3", Verdict::kBad, "silent");
  expect(readings, "peer robot9", Verdict::kBad, "no such name");
}

TEST(Firewall, SwallowsByARuleOfItsPorts) {
  const auto rules = [](const std::string& rule) {
    return swallowing_rules(
        "table inet t {\n\tchain input {\n\t\ttype filter hook input priority filter; policy accept;\n\t\t" + rule +
            "\n\t}\n}\n",
        ports_of(0));
  };
  EXPECT_THAT(rules("udp dport 7400 drop"), ElementsAre("udp dport 7400 drop"));
  EXPECT_THAT(rules("iifname \"wlan0\" udp dport { 53, 7000-7405 } counter packets 0 bytes 0 reject"),
              testing::SizeIs(1));
  EXPECT_THAT(rules("ip saddr 10.0.0.0/8 drop"), testing::SizeIs(1));
  EXPECT_THAT(rules("udp dport 7650-7899 drop"), IsEmpty()) << "another domain's";
  EXPECT_THAT(rules("tcp dport 7400 drop"), IsEmpty());
  EXPECT_THAT(rules("ct state invalid drop"), IsEmpty());
  EXPECT_THAT(rules("udp dport 7400-7649 accept\n\t\tdrop"), IsEmpty()) << "accepted before";
  EXPECT_THAT(rules("drop\n\t\tudp dport 7400-7649 accept"), ElementsAre("drop"));
}

TEST(Firewall, SwallowsByItsPolicyWhatNoRuleAccepts) {
  const std::string head = "table inet t {\n\tchain input {\n\t\ttype filter hook input priority 0; policy drop;\n";
  EXPECT_THAT(swallowing_rules(head + "\t\ttcp dport 22 accept\n\t}\n}\n", ports_of(3)), testing::SizeIs(1));
  EXPECT_THAT(swallowing_rules(head + "\t\tudp dport 7400-9000 accept\n\t}\n}\n", ports_of(3)), IsEmpty());
  EXPECT_THAT(swallowing_rules("chain f {\ntype filter hook forward priority 0; policy drop;\n}\n", ports_of(3)),
              IsEmpty());
  Readings readings = healthy();
  readings.ruleset = head + "\t}\n}\n";
  expect(readings, "firewall", Verdict::kWarn, "policy drop");
  readings.ruleset.reset();
  expect(readings, "firewall", Verdict::kOk, "cannot be read");
}

TEST(InterfaceOfAConfiguration, IsThatWhichCycloneIsTold) {
  EXPECT_EQ(interface_of("<Interfaces><NetworkInterface name=\"wlan0\"/></Interfaces>"), "wlan0");
  EXPECT_EQ(interface_of("<NetworkInterface priority='1' address='172.16.39.3' />"), "172.16.39.3");
  EXPECT_EQ(interface_of("<NetworkInterfaceAddress> eth0</NetworkInterfaceAddress>"), "eth0");
  EXPECT_EQ(interface_of("<General/>"), "");
}

}  // namespace
}  // namespace trivela::monitor::network
