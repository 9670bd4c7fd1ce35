// Who has a certificate of the team's and wants more than was signed for it: on a machine of its own on the team's
// network, and on the robot's loopback. Its own machine stops it nowhere: what refuses it are the others.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>

#include "bus/domain/domain.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "security/certificates.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"
#include "tests/faults/attackers.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kPlenty{20};
constexpr std::uint32_t kForgedWord = 666;

/// This machine's steady clock, which is that of all hosts here.
std::int64_t steady_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

/// The same with an access control that lets its own participant write anything.
bus::DomainConfig lenient(bus::DomainConfig config) {
  const auto replace = [&](const std::string& name, const std::string& by) {
    config.xml.replace(config.xml.find(name), name.size(), by);
  };
  replace("dds_security_ac", TRIVELA_LENIENT_ACCESS);
  replace("init_access_control", "init_lenient_access");
  replace("finalize_access_control", "finalize_lenient_access");
  return config;
}

/// A copy of a node's folder in which governance and permissions, with these topics to write, are signed with the
/// node's own key, and the authority of permissions is one of that key: to its own machine everything is in order.
fs::path signed_by_its_own_key(const fs::path& folder, security::Bus bus, const std::string& node,
                               std::uint32_t robot_id, const std::vector<std::string>& publish, const fs::path& copy) {
  fs::copy(folder, copy, fs::copy_options::recursive);
  const security::Key key = security::read_key((copy / node).string() + ".key");
  const auto validity = security::validity_of(security::read_certificate((copy / node).string() + ".pem"));
  const security::Certificate authority = security::new_authority(key, "Permissions CA", validity);
  security::write_private_file(copy / "permissions_ca.pem", security::pem_of(authority));
  security::write_private_file(copy / "governance.p7s",
                               security::signed_document(security::governance_xml(bus), authority, key));
  security::write_private_file(
      copy / (node + ".p7s"),
      security::signed_document(security::permissions_xml({node, publish, {}}, robot_id, validity), authority, key));
  return copy;
}

class Papers : public Attackers {
 protected:
  /// The team's bus on the attacker's machine, with what machine N has there.
  bus::DomainConfig on_team(const fs::path& papers) const {
    return bus::secured(bus::from_file(config::TeamDomains{}.team, folder / "machine_1" / "team_bus.xml"), papers,
                        "team_bus");
  }
  bus::DomainConfig on_robot(const fs::path& papers, const std::string& node) const {
    return bus::secured(bus::loopback(config::TeamDomains{}.robot, team->tag(1)), papers, node);
  }

  /// Says a referee's word for three seconds; how many ever listened.
  std::size_t say_referee(const bus::Participant& participant, std::uint32_t counter) const {
    bus::Writer<msg::Referee> writer{participant};
    std::size_t most = 0;
    for (int time = 0; time < 30; ++time) {
      msg::Referee word{};
      word.command_counter = counter;
      word.t_ns = steady_ns();
      writer.write(word);
      team->pass(milliseconds{100});
      most = std::max<std::size_t>(most, writer.readers());
    }
    return most;
  }

  /// Says a robot's state for three seconds, with what robot 1 needs to compare clocks.
  void say_state(const bus::Participant& participant, std::uint8_t robot_id) const {
    bus::Writer<msg::TeamState> writer{participant};
    const std::int64_t began = steady_ns();
    for (std::uint64_t seq = 1; seq <= 30; ++seq) {
      msg::TeamState state{};
      state.robot_id = robot_id;
      state.seq = seq;
      state.started_t_ns = began;
      state.t_ns = state.echo_t_ns = state.echo_heard_t_ns = steady_ns();
      state.echoes = true;
      state.echo_robot_id = 1;
      writer.write(state);
      team->pass(milliseconds{100});
    }
  }

  /// Orders as a stronger kick_decision for two seconds; how many ever listened.
  std::size_t say_orders(const bus::Participant& participant) const {
    bus::WriterOptions as_decision;
    as_decision.owner = "kick_decision/1";
    as_decision.strength = 1000;
    bus::Writer<msg::KickOrder> writer{participant, as_decision};
    std::size_t most = 0;
    for (int time = 0; time < kForgedKicks; ++time) {
      msg::KickOrder order{};
      order.robot_id = 1;
      order.seq = static_cast<std::uint64_t>(time + 1);
      order.t_ns = steady_ns();
      order.kick_id = kForgedKick + time;
      writer.write(order);
      team->pass(milliseconds{100});
      most = std::max<std::size_t>(most, writer.readers());
    }
    return most;
  }

  std::int64_t words(std::uint32_t counter) const {
    return rows(fmt::format("referee WHERE command_counter = {}", counter));
  }
};

TEST_F(Papers, ARobotThatSaysARefereeFromAnotherMachineIsHeardByNobodyAndTheBaseIs) {
  keys.keys().issue(3, {"team_link"}, security::days_from(security::this_second(), 9));
  ASSERT_NO_FATAL_FAILURE(start_team());
  const fs::path forged = signed_by_its_own_key(keys.robot(3) / "team", security::Bus::kTeam, "team_bus", 3,
                                                {"referee", "team_state"}, folder / "signed_by_its_own_key");
  on_host(team->attacker(), [&] {
    const bus::Participant signed_itself{on_team(forged)};
    EXPECT_EQ(say_referee(signed_itself, kForgedWord), 0u);
  });
  on_host(team->attacker(), [&] {
    const bus::Participant without_right{lenient(on_team(keys.robot(3) / "team"))};
    say_state(without_right, 3);
    EXPECT_TRUE(team->wait_for(kAirTimeout, [&] { return rows("clock_offsets WHERE other_robot_id = 3") > 0; }))
        << "it is known, and heard in what it may say";
    say_referee(without_right, kForgedWord);
  });
  EXPECT_EQ(words(kForgedWord), 0);
  on_host(team->attacker(), [&] {
    const bus::Participant base{lenient(on_team(keys.robot(0) / "team"))};
    EXPECT_EQ(say_referee(base, kForgedWord + 1), 2u) << "with the base's papers both robots listen";
  });
  EXPECT_TRUE(team->wait_for(kAirTimeout, [&] { return words(kForgedWord + 1) > 0; }))
      << "and take it for the base's word";
  EXPECT_EQ(words(kForgedWord), 0);
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

TEST_F(Papers, ACameraThatOrdersOnTheRobotsLoopbackIsHeardByNobodyAndItsDecisionIs) {
  ASSERT_NO_FATAL_FAILURE(kick_off(true));
  const fs::path forged = signed_by_its_own_key(keys.robot(1), security::Bus::kRobot, "vision", 1, {"kick_order"},
                                                folder / "signed_by_its_own_key");
  on_host(team->host(1), [&] {
    const bus::Participant signed_itself{on_robot(forged, "vision")};
    EXPECT_EQ(say_orders(signed_itself), 0u);
  });
  on_host(team->host(1), [&] {
    const bus::Participant without_right{lenient(on_robot(keys.robot(1), "vision"))};
    bus::Writer<msg::VisionFrame> frames{without_right};
    EXPECT_TRUE(frames.wait_for_readers(1, kPlenty)) << "it is known, and heard in what it may say";
    say_orders(without_right);
  });
  EXPECT_EQ(received(), 0);
  EXPECT_TRUE(plays_on());
  on_host(team->host(1), [&] {
    const bus::Participant decision{lenient(on_robot(keys.robot(1), "kick_decision"))};
    EXPECT_GT(say_orders(decision), 0u) << "with the decision's papers they listen";
  });
  EXPECT_TRUE(team->wait_for(kAirTimeout, [&] { return received() > 0; })) << "and take them for orders";
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

/// Whether robot 1 heard that somebody else says he is robot 1, once states in clear were sent in every mate's name.
bool hears_its_twin_in_clear(TeamOnAir& team) {
  const Packets forged = forged_states(team.attacker(), 1, speakers(team.hub().overheard()));
  EXPECT_FALSE(forged.empty());
  send_to_domain(team.attacker(), "10.77.0.1", config::TeamDomains{}.team, forged);
  team.pass(seconds{1});
  return team.said(1, "team_link").find("somebody else says") != std::string::npos;
}

TEST_F(Papers, AWordInClearInAMatesNameIsHeardByATeamWithoutKeys) {
  ASSERT_NO_FATAL_FAILURE(start_team(false));
  EXPECT_TRUE(hears_its_twin_in_clear(*team)) << "the packets are as good as a mate's";
  team->stop();
}

TEST_F(Papers, AWordInClearInAMatesNameIsHeardByNobodyOfATeamWithKeys) {
  ASSERT_NO_FATAL_FAILURE(start_team());
  EXPECT_FALSE(hears_its_twin_in_clear(*team));
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

}  // namespace
}  // namespace trivela::faults
