// Two members of a secured domain and others beside them, over the loopback's sockets.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <random>
#include <vector>

#include "bus/domain/cyclone.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "security/certificates.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/security/key_fixture.hpp"

namespace trivela::security {
namespace {

namespace fs = std::filesystem;
using bus::DomainConfig;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

constexpr seconds kPlenty{20};

/// Domain instances of this process that share their ports, as the processes of a robot do.
class SharedWire {
 public:
  DomainConfig member() {
    DomainConfig config = pair_.a;
    config.domain_id = 1 + (pair_.a.domain_id - 1 + members_++) % 100;
    return config;
  }

 private:
  bus::WirePair pair_ = bus::fresh_wire_pair();
  std::uint32_t members_ = 0;
};

msg::KickOrder order(std::int64_t kick_id) {
  msg::KickOrder order{};
  order.robot_id = 1;
  order.kick_id = kick_id;
  return order;
}

class SecuredBus : public testing::Test {
 protected:
  SecuredBus() { team.keys().issue(1, {"kick_decision", "kicker_driver", "vision"}, week()); }
  static Validity week() { return days_from(this_second(), 9); }

  DomainConfig as(const std::string& node, const TeamKeys& keys, std::uint32_t robot_id = 1) {
    return bus::secured(wire.member(), keys.robot(robot_id), node);
  }

  /// What the driver hears while the attacker has been writing orders from before anybody else was there: the kick_ids
  /// until the robot's own decision's, which is 1.
  std::vector<std::int64_t> heard_beside(const DomainConfig& attacker) {
    bus::Writer<msg::KickOrder> forged{bus::Participant(attacker)};
    bus::Reader<msg::KickOrder> driver{bus::Participant(as("kicker_driver", team))};
    forged.write(order(666));
    bus::Writer<msg::KickOrder> decision{bus::Participant(as("kick_decision", team))};
    EXPECT_TRUE(decision.wait_for_readers(1, kPlenty));
    EXPECT_TRUE(driver.wait_for_writers(1, kPlenty));
    forged.write(order(666));
    decision.write(order(1));
    std::vector<std::int64_t> received;
    while (received.empty() || received.back() != 1) {
      if (!driver.wait(kPlenty)) break;
      driver.take([&](const msg::KickOrder& order, const auto&) { received.push_back(order.kick_id); });
    }
    EXPECT_EQ(driver.writers(), 1u);
    EXPECT_EQ(forged.readers(), 0u);
    return received;
  }

  TeamKeys team;
  SharedWire wire;
};

TEST_F(SecuredBus, TheRobotsOwnDecisionIsHeardAndNobodyWithoutACertificate) {
  EXPECT_THAT(heard_beside(wire.member()), ElementsAre(1));
}

TEST_F(SecuredBus, ADecisionWithTheCertificateOfAnotherAuthorityIsNotHeard) {
  const TeamKeys others;
  others.keys().issue(1, {"kick_decision"}, week());
  EXPECT_THAT(heard_beside(as("kick_decision", others)), ElementsAre(1));
}

TEST_F(SecuredBus, TheDecisionOfAnotherRobotIsNotHeard) {
  team.keys().issue(2, {"kick_decision"}, week());
  EXPECT_THAT(heard_beside(as("kick_decision", team, 2)), ElementsAre(1));
}

TEST_F(SecuredBus, ANodeWithoutTheRightCannotWriteAnOrder) {
  const bus::Participant vision(as("vision", team));
  EXPECT_NO_THROW(bus::Writer<msg::VisionFrame>{vision});
  EXPECT_THROW(bus::Writer<msg::KickOrder>{vision}, bus::Error);
  EXPECT_THROW(bus::Reader<msg::Referee>{vision}, bus::Error);
}

/// Permissions to write orders that the node signed with its own key.
void sign_for_itself(const fs::path& folder, const std::string& node) {
  const std::string own = (folder / node).string();
  const Certificate certificate = read_certificate(own + ".pem");
  const std::string xml = permissions_xml({node, {"kick_order"}, {}}, 1, validity_of(certificate));
  write_private_file(own + ".p7s", signed_document(xml, certificate, read_key(own + ".key")));
}

TEST_F(SecuredBus, PermissionsThatANodeSignedForItselfLetItNotEvenJoin) {
  sign_for_itself(team.robot(1), "vision");
  EXPECT_THROW(bus::Participant(as("vision", team)), bus::Error);
}

TEST_F(SecuredBus, OneCertificateForBothAuthoritiesIsRefused) {
  fs::copy_file(team.robot(1) / "identity_ca.pem", team.robot(1) / "permissions_ca.pem",
                fs::copy_options::overwrite_existing);
  EXPECT_THROW(as("vision", team), bus::Error);
}

TEST_F(SecuredBus, AKeyThatOthersMayReadIsRefused) {
  fs::permissions(team.robot(1) / "vision.key", fs::perms::others_read, fs::perm_options::add);
  EXPECT_THROW(as("vision", team), bus::Error);
}

/// The bus between the machines: the base says the referee, a robot hears it, others try to be heard too.
class SecuredTeamBus : public SecuredBus {
 protected:
  SecuredTeamBus() {
    team.keys().issue(0, {"team_link"}, week());
    team.keys().issue(1, {"team_link", "refbox"}, week());
    team.keys().issue(2, {"team_link"}, week());
  }
  DomainConfig on_team(std::uint32_t robot_id) { return on_team(team, robot_id); }
  DomainConfig on_team(const TeamKeys& keys, std::uint32_t robot_id) {
    return bus::secured(wire.member(), keys.robot(robot_id) / "team", "team_bus");
  }

  static msg::Referee word(std::uint32_t command_counter) {
    msg::Referee word{};
    word.command_counter = command_counter;
    return word;
  }

  /// What robot 2 hears while the attacker says "666" from before anybody else was there, up to the base's own word.
  std::vector<std::uint32_t> heard_beside(const DomainConfig& attacker) {
    bus::Writer<msg::Referee> forged{bus::Participant(attacker)};
    bus::Reader<msg::Referee> robot{bus::Participant(on_team(2))};
    forged.write(word(666));
    bus::Writer<msg::Referee> base{bus::Participant(on_team(0))};
    EXPECT_TRUE(base.wait_for_readers(1, kPlenty));
    EXPECT_TRUE(robot.wait_for_writers(1, kPlenty));
    forged.write(word(666));
    base.write(word(1));
    std::vector<std::uint32_t> received;
    while (received.empty() || received.back() != 1) {
      if (!robot.wait(kPlenty)) break;
      robot.take([&](const msg::Referee& word, const auto&) { received.push_back(word.command_counter); });
    }
    EXPECT_EQ(forged.readers(), 0u);
    return received;
  }
};

TEST_F(SecuredTeamBus, TheBaseIsHeardAndNobodyWithoutACertificate) {
  EXPECT_THAT(heard_beside(wire.member()), ElementsAre(1));
}

TEST_F(SecuredTeamBus, TheBaseOfAnotherTeamIsNotHeard) {
  const TeamKeys others;
  others.keys().issue(0, {"team_link"}, week());
  EXPECT_THAT(heard_beside(on_team(others, 0)), ElementsAre(1));
}

TEST_F(SecuredTeamBus, ARobotsOwnRefboxIsUnknownThere) {
  EXPECT_THAT(heard_beside(as("refbox", team)), ElementsAre(1));
}

TEST_F(SecuredTeamBus, ARobotMaySayItsStateAndNoReferee) {
  const bus::Participant robot(on_team(1));
  EXPECT_NO_THROW(bus::Writer<msg::TeamState>{robot});
  EXPECT_NO_THROW(bus::Reader<msg::Referee>{robot});
  EXPECT_THROW(bus::Writer<msg::Referee>{robot}, bus::Error);
  EXPECT_THROW(bus::Writer<msg::KickOrder>{robot}, bus::Error);
}

TEST_F(SecuredTeamBus, PermissionsOfTheRobotsOwnBusAreOfNoUseThere) {
  // On its own bus a team_link says the referee's word.
  fs::copy_file(team.robot(1) / "team_link.p7s", team.robot(1) / "team" / "team_bus.p7s",
                fs::copy_options::overwrite_existing);
  EXPECT_THROW(bus::Participant(on_team(1)), bus::Error);
}

TEST_F(SecuredTeamBus, PermissionsThatItSignedForItselfLetItNotEvenJoin) {
  sign_for_itself(team.robot(1) / "team", "team_bus");
  EXPECT_THROW(bus::Participant(on_team(1)), bus::Error);
}

// Why one authority for both is refused: CVE-2023-24011. Should this fail, the installed Cyclone is mended.
TEST_F(SecuredBus, WithOneAuthorityForBothDebiansCycloneTakesWhatANodeSignedForItself) {
  const fs::path folder = team.robot(1);
  const Certificate both = read_certificate(folder / "identity_ca.pem");
  const Key key = read_key(team.authority() / "identity_ca_1.key");
  write_private_file(folder / "permissions_ca.pem", pem_of(both) + "\n");  // the guard compares the files
  write_private_file(folder / "governance.p7s", signed_document(governance_xml(Bus::kRobot), both, key));
  write_private_file(folder / "kicker_driver.p7s",
                     signed_document(permissions_xml(rights_of("kicker_driver"), 1,
                                                     validity_of(read_certificate(folder / "kicker_driver.pem"))),
                                     both, key));
  sign_for_itself(folder, "vision");
  bus::Writer<msg::KickOrder> forged{bus::Participant(as("vision", team))};
  bus::Reader<msg::KickOrder> driver{bus::Participant(as("kicker_driver", team))};
  EXPECT_TRUE(forged.wait_for_readers(1, kPlenty));
  forged.write(order(666));
  EXPECT_TRUE(driver.wait(kPlenty));
}

/// Every packet on the loopback, from its making on.
class Tap {
 public:
  Tap() : socket_(::socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_IP))) {
    const int room = 64 << 20;  // discovery alone is hundreds of packets
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
  }
  Tap(const Tap&) = delete;
  Tap& operator=(const Tap&) = delete;
  ~Tap() { ::close(socket_); }
  bool permitted() const { return socket_ >= 0; }

  /// Whether the bytes were in any packet until now.
  bool saw(std::string_view bytes) {
    std::array<char, 65536> packet{};
    bool seen = false;
    for (ssize_t size = 0; (size = ::recv(socket_, packet.data(), packet.size(), 0)) > 0;)
      seen =
          seen || std::string_view{packet.data(), static_cast<std::size_t>(size)}.find(bytes) != std::string_view::npos;
    tpacket_stats count{};
    socklen_t size = sizeof count;
    EXPECT_EQ(::getsockopt(socket_, SOL_PACKET, PACKET_STATISTICS, &count, &size), 0);
    EXPECT_EQ(count.tp_drops, 0u);
    return seen;
  }

 private:
  int socket_;
};

/// A sample from one to the other whose t_ns are bytes that nobody else sends; whether these were to be read on the
/// wire.
template <bus::Message T>
bool readable(const DomainConfig& from, const DomainConfig& to) {
  std::random_device random;
  const std::int64_t bytes = std::int64_t{0x6c6f'6769} << 32 | random();
  Tap wiretap;
  bus::Reader<T> reader{bus::Participant(to)};
  bus::Writer<T> writer{bus::Participant(from)};
  EXPECT_TRUE(writer.wait_for_readers(1, kPlenty));
  T sample{};
  sample.robot_id = 1;
  sample.t_ns = bytes;
  writer.write(sample);
  EXPECT_TRUE(reader.wait(kPlenty));
  return wiretap.saw({reinterpret_cast<const char*>(&bytes), sizeof bytes});
}

TEST_F(SecuredBus, OrderAndStatusCannotBeReadOnTheWire) {
  if (!Tap{}.permitted()) GTEST_SKIP() << "listening to the loopback needs CAP_NET_RAW";
  team.keys().issue(1, {"kick_decision", "kicker_driver", "recorder"}, week());
  EXPECT_FALSE(readable<msg::KickOrder>(as("kick_decision", team), as("kicker_driver", team)));
  EXPECT_FALSE(readable<msg::KickerStatus>(as("kicker_driver", team), as("recorder", team)));
  SharedWire clear;
  EXPECT_TRUE(readable<msg::KickOrder>(clear.member(), clear.member())) << "without security it is there";
  EXPECT_TRUE(readable<msg::KickerStatus>(clear.member(), clear.member()));
}

TEST_F(SecuredTeamBus, RefereeAndStateCannotBeReadOnTheWire) {
  if (!Tap{}.permitted()) GTEST_SKIP() << "listening to the loopback needs CAP_NET_RAW";
  EXPECT_FALSE(readable<msg::Referee>(on_team(0), on_team(1)));
  EXPECT_FALSE(readable<msg::TeamState>(on_team(1), on_team(2)));
  SharedWire clear;
  EXPECT_TRUE(readable<msg::Referee>(clear.member(), clear.member()));
  EXPECT_TRUE(readable<msg::TeamState>(clear.member(), clear.member()));
}

TEST_F(SecuredBus, WhoMayDoWhatTravelsInClearInTheHandshake) {
  Tap wiretap;
  if (!wiretap.permitted()) GTEST_SKIP() << "listening to the loopback needs CAP_NET_RAW";
  const bus::Reader<msg::KickOrder> reader{bus::Participant(as("kicker_driver", team))};
  const bus::Writer<msg::KickOrder> writer{bus::Participant(as("kick_decision", team))};
  ASSERT_TRUE(writer.wait_for_readers(1, kPlenty));
  EXPECT_TRUE(wiretap.saw("<topic>kick_order</topic>"));
}

}  // namespace
}  // namespace trivela::security
