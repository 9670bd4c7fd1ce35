// `trivela doctor --network` in network namespaces of its own, each with one thing wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Doctor : public testing::Test {
 protected:
  tests::Folder folder_;

  void SetUp() override {
    if (std::system("unshare -rn ip link set lo up 2>/dev/null") != 0)
      GTEST_SKIP() << "this machine lets nobody make a network namespace";
  }

  /// The exit code where `setup` was done in a namespace of its own before.
  int examine(const std::string& setup, const std::string& flags = "--interface team0") {
    const std::string command =
        "set -e\nip link set lo up\n" + setup + "\nexec \"$0\" doctor --network --json --domain 61 " + flags;
    const std::string trivela = std::string{TRIVELA_BINARY_DIR} + "/trivela";
    Program program("/usr/bin/unshare", {"-rn", "bash", "-c", command, trivela}, folder_.path());
    const int code = program.wait();
    findings_ = json::parse(program.output(), nullptr, false);
    EXPECT_TRUE(findings_.is_array()) << program.errors();
    return code;
  }

  json finding(const std::string& check) const {
    for (const json& one : findings_)
      if (one["check"] == check) return one;
    return {{"verdict", "there is no " + check}, {"value", ""}};
  }
  std::string verdict(const std::string& check) const { return finding(check)["verdict"]; }
  std::string value(const std::string& check) const { return finding(check)["value"]; }

  static constexpr const char* kUp =
      "ip link add team0 type veth peer name air0\nip address add 172.16.39.3/24 dev team0\n"
      "ip link set team0 up\nip link set air0 up";

 private:
  json findings_;
};

TEST_F(Doctor, FindsNothingBadWhereTheNetworkIsWell) {
  EXPECT_EQ(examine(kUp, "--interface team0 --peers 172.16.39.3"), 0);
  EXPECT_EQ(verdict("interface"), "ok") << value("interface");
  EXPECT_EQ(verdict("multicast"), "ok") << value("multicast");
  EXPECT_EQ(verdict("own address"), "ok");
  EXPECT_EQ(verdict("peer 172.16.39.3"), "ok");
}

TEST_F(Doctor, FindsAnInterfaceThatIsDownAndOneThatIsNotThere) {
  EXPECT_EQ(examine("ip link add team0 type veth peer name air0\nip address add 172.16.39.3/24 dev team0"), 1);
  EXPECT_THAT(value("interface"), HasSubstr("team0 is down"));
  EXPECT_EQ(examine("true"), 1);
  EXPECT_THAT(value("interface"), HasSubstr("there is no team0"));
  EXPECT_EQ(examine("true", ""), 1);
  EXPECT_THAT(value("interface"), HasSubstr("none but loopback"));
}

TEST_F(Doctor, FindsAnInterfaceWithoutMulticast) {
  EXPECT_EQ(examine(std::string{kUp} + "\nip link set team0 multicast off"), 1);
  EXPECT_THAT(value("multicast"), HasSubstr("no MULTICAST flag"));
}

TEST_F(Doctor, FindsAPeerThatIsSilent) {
  EXPECT_EQ(examine(kUp, "--interface team0 --peers 172.16.39.9"), 1);
  EXPECT_EQ(value("peer 172.16.39.9"), "silent");
}

TEST_F(Doctor, ATeamsFileSaysInterfaceAndPeers) {
  std::ofstream(folder_.path() / "team.toml")
      << "[team]\nname = \"t\"\nnumber = 39\nnetwork = \"172.16.39.0/24\"\ninterface = \"team0\"\n"
         "group = \"224.16.32.39\"\nlogs = \"/var/lib/trivela\"\n[domains]\nrobot = 60\nteam = 61\n"
         "[[robot]]\nnumber = 3\naddress = \"172.16.39.3\"\nrobot = \"" TRIVELA_SOURCE_DIR
         "/config/robots/cambada_1.toml\"\n[base]\naddress = \"172.16.39.9\"\n";
  EXPECT_EQ(examine(kUp, "--team " + (folder_.path() / "team.toml").string()), 1);
  EXPECT_EQ(verdict("interface"), "ok") << value("interface");
  EXPECT_EQ(verdict("peer 172.16.39.3"), "ok");
  EXPECT_EQ(value("peer 172.16.39.9"), "silent");
}

TEST_F(Doctor, FindsAFirewallThatSwallows) {
  if (std::system("nft --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no nft";
  EXPECT_EQ(examine(std::string{kUp} +
                    "\nnft add table inet t\nnft add chain inet t input '{ type filter hook input priority 0; }'\n"
                    "nft add rule inet t input udp dport 22650-22899 drop"),
            1);
  EXPECT_EQ(verdict("multicast"), "bad");
  EXPECT_EQ(verdict("own address"), "bad");
  EXPECT_THAT(value("firewall"), HasSubstr("udp dport 22650-22899 drop"));
  EXPECT_THAT(value("domain"), HasSubstr("not joined")) << "it would never have left";
}

TEST_F(Doctor, WantsToKnowWhatToExamine) {
  const tests::Folder folder;
  Program program("trivela", {"doctor"}, folder.path());
  EXPECT_EQ(program.wait(), 2);
  EXPECT_THAT(program.errors(), HasSubstr("--network"));
}

}  // namespace
}  // namespace trivela::e2e
