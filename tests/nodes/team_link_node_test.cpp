// A robot's and the base's team_link, each between a machine's own bus and the team's, over sockets.
#include "nodes/team_link/team_link_node.hpp"

#include "log/read/reader.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using testing::HasSubstr;

/// A machine: its own bus, and the team's by a domain instance of its own, as another process would have it.
class Machine {
 public:
  Machine(bus::DomainConfig own, bus::DomainConfig team, bool base, std::uint32_t robot_id, bool referee = true)
      : participant(own), log_lines(std::make_shared<LogLines>()) {
    context.settings.domain.domain_id = own.domain_id;
    context.settings.run.robot_id = robot_id;
    context.settings.team_link.base = base;
    context.settings.team_link.referee = referee;
    node = std::make_unique<TeamLinkNode>(context, team);
  }
  void start() { running.emplace(bus::Executor::kListener, stop, std::vector{&node->node()}); }

  bus::Participant participant;
  bus::Stop stop;
  std::shared_ptr<LogLines> log_lines;
  NodeContext context{{}, {}, participant, std::make_shared<spdlog::logger>("test", log_lines), stop};
  std::unique_ptr<TeamLinkNode> node;
  std::optional<Running> running;
};

class TeamLinkTest : public testing::Test {
 protected:
  TeamLinkTest() {
    // Ids of one process must differ; the team's two are one domain on the wire.
    const std::uint32_t team_id = robot_bus.domain_id;
    robot_bus.domain_id = (team_id + 20) % 100 + 1;
    base_bus.domain_id = (team_id + 40) % 100 + 1;
    team_of_base.domain_id = (team_id + 60) % 100 + 1;
    team_of_robot.domain_id = (team_id + 80) % 100 + 1;
    for (bus::DomainConfig* const team : {&team_of_base, &team_of_robot}) {
      team->xml = robot_team_xml;
      const std::string external = fmt::format("<Discovery><ExternalDomainId>{}</ExternalDomainId>", team_id);
      team->xml.replace(team->xml.find("<Discovery>"), std::string("<Discovery>").size(), external);
    }
  }

  msg::Referee word(bool playing) {
    msg::Referee word{};
    word.t_ns = now_ns(std::chrono::steady_clock::now());
    word.playing = playing;
    word.half = 1;
    return word;
  }

  bus::DomainConfig robot_bus = bus::fresh_domain(), base_bus = bus::fresh_domain();
  std::string robot_team_xml = bus::fresh_domain().xml;
  bus::DomainConfig team_of_base, team_of_robot;
};

/// Says something again and again until `done`; false: it took too long.
bool until(const std::function<bool()>& done, const std::function<void()>& say) {
  const auto end = std::chrono::steady_clock::now() + kPlenty;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    say();
    bus::Stop pause;
    pause.wait_until(std::chrono::steady_clock::now() + std::chrono::milliseconds{20});
  }
  return true;
}

TEST_F(TeamLinkTest, TheBasesRefereeComesToTheRobotByItsNumberAndNothingElseDoes) {
  Machine base{base_bus, team_of_base, true, 1}, robot{robot_bus, team_of_robot, false, 3};
  Says<msg::Referee> box_for_one{base.participant, 1}, box_for_two{base.participant, 2};
  Says<msg::WorldState> world{robot.participant, 3};
  Says<msg::KickOrder> order{robot.participant, 3};
  Received<msg::Referee> at_robot{robot.participant};
  Received<msg::WorldState> world_at_base{base.participant};
  Received<msg::KickOrder> orders_at_base{base.participant};
  Received<msg::TeamHeard> at_base{base.participant};
  base.start();
  robot.start();
  const auto placed = [&] {
    for (const auto& received : at_base.now())
      if (received.summary.placed && received.clock_known) return true;
    return false;
  };
  msg::WorldState pose{};
  pose.x_m = 2.5;
  ASSERT_TRUE(until([&] { return placed() && at_robot.now().size() >= 3; },
                    [&] {
                      box_for_one(word(true));
                      box_for_two(word(false));
                      world(pose);
                      order({});
                    }));
  for (const msg::Referee& received : at_robot.now()) {
    EXPECT_EQ(received.robot_id, 3);
    EXPECT_TRUE(received.playing) << "the word of robot 1 alone goes out";
    EXPECT_LE(received.t_ns, now_ns(std::chrono::steady_clock::now()));
  }
  const msg::TeamHeard last = at_base.now().back();
  EXPECT_EQ(last.robot_id, 0);
  EXPECT_EQ(last.other_robot_id, 3);
  EXPECT_EQ(last.summary.x_m, 2.5);
  EXPECT_LE(std::abs(last.offset_ns), last.error_ns) << "one machine, one clock";
  EXPECT_TRUE(world_at_base.now().empty());
  EXPECT_TRUE(orders_at_base.now().empty());
}

TEST_F(TeamLinkTest, ARobotWithARefereeOfItsOwnIsGivenNoOther) {
  Machine base{base_bus, team_of_base, true, 1}, robot{robot_bus, team_of_robot, false, 1, false};
  Says<msg::Referee> box{base.participant, 1};
  Received<msg::Referee> at_robot{robot.participant};
  Received<msg::TeamHeard> received{robot.participant};
  base.start();
  robot.start();
  const auto met = [&] {
    for (const auto& h : received.now())
      if (h.clock_known && h.summary.playing) return true;
    return false;
  };
  ASSERT_TRUE(until(met, [&] { box(word(true)); }));
  EXPECT_TRUE(at_robot.now().empty());
}

TEST_F(TeamLinkTest, IsRefusedBesideAnotherReferee) {
  const bus::Participant participant{robot_bus};
  bus::Node refbox{participant, "refbox"};
  const auto writer = refbox.writer<msg::Referee>(referee_of(1));
  try {
    const Machine robot{robot_bus, team_of_robot, false, 1};
    FAIL() << "there are two";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another referee of robot 1"));
  }
}

TEST_F(TeamLinkTest, TwoOfOneNumberAreToldApart) {
  Machine one{base_bus, team_of_base, false, 2, false}, two{robot_bus, team_of_robot, false, 2, false};
  one.start();
  two.start();
  EXPECT_TRUE(one.log_lines->wait_for("somebody else says on the team's bus that it is robot 2"));
}

TEST_F(TeamLinkTest, ATeamsBusThatCannotBeJoinedIsNoErrorOfTheNode) {
  bus::DomainConfig broken = team_of_robot;
  const auto lo = broken.xml.find("name=\"lo\"");
  ASSERT_NE(lo, std::string::npos);
  broken.xml.replace(lo, 9, "name=\"no_such0\"");
  Machine robot{robot_bus, broken, false, 1, false};
  robot.start();
  EXPECT_TRUE(robot.log_lines->wait_for("not on the team's bus"));
  EXPECT_EQ(robot.stop.requested(), false);
}

TEST_F(TeamLinkTest, AnInterfaceWithoutAnAddressIsWaitedFor) {
  bus::DomainConfig domain = team_of_robot;
  const bus::Participant participant{robot_bus};
  bus::Stop stop;
  const auto lines = std::make_shared<LogLines>();
  NodeContext context{{}, {}, participant, std::make_shared<spdlog::logger>("test", lines), stop};
  context.settings.team_link.interface = "no_such0";
  context.settings.team_link.referee = false;
  TeamLinkNode node{context, domain};
  EXPECT_TRUE(lines->wait_for("there is no interface no_such0: there are "));
}

TEST(TeamDomain, NamesTheSettingThatIsMissing) {
  config::Settings settings;
  EXPECT_THROW(team_domain(settings, ""), std::runtime_error);
  settings.team_link.dds_file = "/nowhere/team_bus.xml";
  EXPECT_THROW(team_domain(settings, ""), bus::Error);
  settings.team_link.domain_id = settings.domain.domain_id;
  try {
    team_domain(settings, "");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("team_link.domain_id = 42"));
  }
}

}  // namespace
}  // namespace trivela::nodes
