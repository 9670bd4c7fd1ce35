// What `trivela team configure` writes for Cyclone, on real participants.
#include "config/team/team_bus.hpp"
#include "config/team/team_settings.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Two domain instances of this process with these configurations, which meet where their tags let them.
WirePair wired(const std::string& a, const std::string& b) {
  const std::uint32_t domain = fresh_domain().domain_id;
  const auto external = [domain](std::string xml) {
    const std::string opening = "<Discovery>";
    return xml.insert(xml.find(opening) + opening.size(),
                      fmt::format("<ExternalDomainId>{}</ExternalDomainId>", domain));
  };
  return {{domain, external(a)}, {domain % 100 + 1, external(b)}};
}

config::Team team_here() {
  config::Team team;
  team.team.name = fmt::format("team-{}", getpid());
  team.base.address = "127.0.0.1";
  return team;
}

msg::Referee a_word() {
  msg::Referee referee{};
  referee.robot_id = 1;
  return referee;
}

TEST(TeamBusXml, TwoRobotsOwnBusesInOneDomainNeverHearEachOther) {
  const config::Team team = team_here();
  const auto own_bus = [&](std::uint32_t robot) {
    return loopback(0, config::tag_of(team, {.number = robot,
                                             .address = {},
                                             .robot = {},
                                             .policy = {},
                                             .settings = {},
                                             .interface = {},
                                             .lines = {}}))
        .xml;
  };
  const WirePair robots = wired(own_bus(1), own_bus(2));
  const WirePair again = {{robots.b.domain_id % 100 + 1, robots.a.xml}, {}};
  Reader<msg::Referee> other{Participant(robots.b)};
  Writer<msg::Referee> writer{Participant(robots.a)};
  writer.write(a_word());
  // A reader with the writer's own configuration that came later has long matched and been served.
  Reader<msg::Referee> own{Participant(again.a)};
  ASSERT_TRUE(own.wait(seconds(10)));
  EXPECT_FALSE(other.wait(milliseconds(100)));
  EXPECT_EQ(other.writers(), 0u);
}

TEST(TeamBusXml, TwoMachinesHearEachOtherByPeers) {
  const std::string xml = config::team_bus_xml(team_here(), "lo");
  const WirePair machines = wired(xml, xml);
  Writer<msg::Referee> base{Participant(machines.a)};
  base.write(a_word());
  Reader<msg::Referee> robot{Participant(machines.b)};
  EXPECT_TRUE(robot.wait(seconds(10)));
}

// lo says that it has no multicast, which it has.
TEST(TeamBusXml, TwoMachinesHearEachOtherByGroup) {
  config::Team team = team_here();
  team.team.group = "224.16.32.39";
  const std::string xml = config::team_bus_xml(team, R"(lo" multicast="true)");
  const WirePair machines = wired(xml, xml);
  Writer<msg::Referee> base{Participant(machines.a)};
  base.write(a_word());
  Reader<msg::Referee> robot{Participant(machines.b)};
  EXPECT_TRUE(robot.wait(seconds(10)));
}

}  // namespace
}  // namespace trivela::bus
