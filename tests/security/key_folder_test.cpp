#include "security/key_folder.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "security/certificates.hpp"
#include "security/rights.hpp"
#include "tests/security/key_fixture.hpp"

namespace trivela::security {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::chrono::sys_seconds kNow = std::chrono::sys_days{2026y / 7 / 1} + 12h;
const Validity kWeek = days_from(kNow, 9);

class Keys : public testing::Test {
 protected:
  Keys() {
    team.keys().issue(1, {"kick_decision", "kicker_driver"}, kWeek);
    team.keys().issue(2, {"kick_decision"}, kWeek);
  }
  std::vector<std::string> faults(std::chrono::sys_seconds now = kNow) const { return faults_of(team.keys(), now); }

  TeamKeys team{kWeek};
};

TEST_F(Keys, AsTheyAreMadeNothingIsWrong) {
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_THAT(team.keys().robots(), ElementsAre(1, 2));
  EXPECT_THAT(team.keys().nodes(1), ElementsAre("kick_decision", "kicker_driver"));
}

TEST_F(Keys, NobodyElseCanReadThem) {
  for (const fs::path& folder : {team.robot(1), team.authority()}) {
    EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
    for (const auto& entry : fs::recursive_directory_iterator{folder})
      EXPECT_EQ(fs::status(entry).permissions(),
                entry.is_directory() ? fs::perms::owner_all : fs::perms::owner_read | fs::perms::owner_write)
          << entry;
  }
  fs::permissions(team.robot(1) / "kicker_driver.key", fs::perms::group_read, fs::perm_options::add);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("kicker_driver.key: somebody else than its owner may read")));
}

TEST_F(Keys, AFolderThatOthersMayWriteToIsNamed) {
  fs::permissions(team.keys().path(), fs::perms::others_write, fs::perm_options::add);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("somebody else than its owner may put other keys into it")));
}

TEST(KeysOfNobody, AFolderThatIsNotThereIsNamedAsSuch) {
  EXPECT_THAT(faults_of(KeyFolder{"/nowhere/keys"}, kNow), ElementsAre("/nowhere/keys: there is no such folder"));
}

TEST_F(Keys, ADeviceInTheirPlaceIsNotRead) {
  fs::remove(team.robot(1) / "kicker_driver.p7s");
  fs::create_symlink("/dev/zero", team.robot(1) / "kicker_driver.p7s");
  EXPECT_THAT(faults(), Contains(HasSubstr("kicker_driver.p7s: is no file of at most 1 MB")));
}

TEST_F(Keys, HoldForTheWeekAlone) {
  EXPECT_THAT(faults(kWeek.to - 1s), IsEmpty());
  EXPECT_THAT(faults(kWeek.to), Contains(HasSubstr("kick_decision.pem: holds from 2026-07-01 11:00:00 to 2026-07-10 "
                                                   "12:00:00 UTC, and this machine's clock says 2026-07-10 12:00:00")));
  EXPECT_THAT(faults(std::chrono::sys_days{1970y / 1 / 2}), Contains(HasSubstr("clock says 1970-01-02"))) << "no RTC";
}

TEST_F(Keys, ARenewedNodeHasAnotherKeyAndTheSameName) {
  const std::string before = read_text(team.robot(1) / "kick_decision.key");
  const Validity next = days_from(kNow + 240h, 9);
  team.keys().renew(next);
  EXPECT_NE(read_text(team.robot(1) / "kick_decision.key"), before);
  EXPECT_EQ(subject_of(read_certificate(team.robot(1) / "kick_decision.pem")), "O=Trivela,CN=kick_decision.1");
  EXPECT_THAT(faults(kNow + 240h), IsEmpty());
}

TEST_F(Keys, ARevokedNodeIsUnknownToItsRobotAndNoOtherRobotChanges) {
  const Certificate lost = read_certificate(team.robot(1) / "kick_decision.pem");
  const std::string other = read_text(team.robot(2) / "kick_decision.pem");
  team.keys().revoke(1, "kick_decision", kWeek);
  EXPECT_FALSE(is_signed_by(lost, read_certificate(team.robot(1) / "identity_ca.pem")));
  EXPECT_THAT(team.keys().nodes(1), ElementsAre("kicker_driver"));
  EXPECT_EQ(read_text(team.robot(2) / "kick_decision.pem"), other);
  EXPECT_THAT(faults(), IsEmpty());
  const Certificate on_team = read_certificate(team.robot(2) / "team" / "team_bus.pem");
  team.keys().revoke_robot(2, kWeek);
  EXPECT_THAT(team.keys().robots(), ElementsAre(1));
  EXPECT_FALSE(is_signed_by(on_team, read_certificate(team.robot(1) / "team" / "identity_ca.pem")));
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(Keys, AllHaveOneAuthorityOnTheTeamsBusWhichIsOfNoUseOnARobotsOwn) {
  team.keys().issue(0, usual_nodes(0), kWeek);
  EXPECT_THAT(team.keys().nodes(0), ElementsAre("recorder", "refbox", "team_link"));
  EXPECT_THAT(faults(), IsEmpty());
  const Certificate of_team = read_certificate(team.robot(0) / "team" / "identity_ca.pem");
  for (const std::uint32_t robot_id : {0u, 1u, 2u}) {
    const Certificate on_team = read_certificate(team.robot(robot_id) / "team" / "team_bus.pem");
    EXPECT_TRUE(is_signed_by(on_team, of_team));
    EXPECT_FALSE(is_signed_by(on_team, read_certificate(team.robot(robot_id) / "identity_ca.pem")));
    EXPECT_FALSE(is_signed_by(read_certificate(team.robot(1) / "kick_decision.pem"), of_team));
  }
  fs::remove(team.robot(2) / "team" / "team_bus.p7s");
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("team_bus.p7s: cannot be read")));
}

TEST_F(Keys, ANodeOfAnotherRobotIsUnknown) {
  EXPECT_FALSE(is_signed_by(read_certificate(team.robot(2) / "kick_decision.pem"),
                            read_certificate(team.robot(1) / "identity_ca.pem")));
  for (const char* ending : {".pem", ".key", ".p7s"})
    fs::copy_file(team.robot(2) / (std::string("kick_decision") + ending),
                  team.robot(1) / (std::string("kick_decision") + ending), fs::copy_options::overwrite_existing);
  EXPECT_THAT(faults(), Contains(HasSubstr("is not signed by the identity authority beside it")));
  EXPECT_THAT(faults(),
              Contains(HasSubstr("is of O=Trivela,CN=kick_decision.2, must be of O=Trivela,CN=kick_decision.1")));
}

TEST_F(Keys, OneAuthorityForBothIsRefused) {
  fs::copy_file(team.robot(1) / "identity_ca.pem", team.robot(1) / "permissions_ca.pem",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(faults(), Contains(HasSubstr("CVE-2023-24011")));
  for (const char* ending : {".pem", ".key"})
    fs::copy_file(team.authority() / (std::string("permissions_ca") + ending),
                  team.authority() / (std::string("identity_ca_1") + ending), fs::copy_options::overwrite_existing);
  EXPECT_THROW(team.keys().renew(kWeek), std::runtime_error);
}

TEST_F(Keys, PermissionsThatANodeSignedForItselfAreSeen) {
  const std::string all = permissions_xml({"kick_decision", {"*"}, {"*"}}, 1, kWeek);
  const fs::path own = team.robot(1) / "kick_decision";
  write_private_file(own.string() + ".p7s",
                     signed_document(all, read_certificate(own.string() + ".pem"), read_key(own.string() + ".key")));
  EXPECT_THAT(faults(),
              ElementsAre(HasSubstr("kick_decision.p7s: is not signed by the permissions authority's own key")));
}

TEST_F(Keys, AChangedWordOfSignedPermissionsIsSeen) {
  std::string text = read_text(team.robot(1) / "kicker_driver.p7s");
  text.replace(text.find("kick_receipt"), 12, "kick_order  ");
  write_private_file(team.robot(1) / "kicker_driver.p7s", text);
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("kicker_driver.p7s: is not signed")));
}

TEST_F(Keys, AMissingFileIsNamed) {
  fs::remove(team.robot(1) / "kicker_driver.pem");
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("kicker_driver.pem: cannot be read")));
}

TEST_F(Keys, AFolderThatHasAnAuthorityIsNotMadeAnew) { EXPECT_THROW(team.keys().init(kWeek), std::runtime_error); }

}  // namespace
}  // namespace trivela::security
