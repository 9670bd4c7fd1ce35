// A match whose nodes hold keys, and nodes that do not.
#include <gmock/gmock.h>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> short_match(const std::string& out) {
  return {"match", "--half", "moving", "--minutes", "0.2", "--seed", "1", "--out", out};
}

std::vector<std::string> with(std::vector<std::string> some, const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

TEST(Secure, AMatchWithKeysHasTheRowsOfOneWithoutAndLeavesNoKeys) {
  const tests::Folder folder;
  Program plain{"trivela", short_match("plain.db"), folder.path()};
  ASSERT_EQ(plain.wait(), 0) << plain.errors();
  Program secured{"trivela", with(short_match("secured.db"), {"--secure"}), folder.path()};
  ASSERT_EQ(secured.wait(), 0) << secured.errors();
  EXPECT_EQ(secured.errors(), "");
  const Reader first{folder / "plain.db"};
  EXPECT_GE(number_of(first, "SELECT count(*) FROM kick_orders"), 2);
  EXPECT_THAT(differences_of(first, Reader{folder / "secured.db"}), IsEmpty());
  for (const auto& entry : std::filesystem::directory_iterator{folder.path()})
    EXPECT_FALSE(entry.path().filename().string().starts_with("trivela_keys")) << "in TMPDIR";
}

TEST(Secure, AMatchPlaysWithATeamsKeysAndSaysWhatIsWrongWithThem) {
  const tests::Folder folder;
  Program made{"trivela", {"keys", "init", "--dir", "keys", "--robot", "1"}, folder.path()};
  ASSERT_EQ(made.wait(), 0) << made.errors();
  Program world{"trivela", {"keys", "issue", "--dir", "keys", "--robot", "1", "--node", "simulator"}, folder.path()};
  ASSERT_EQ(world.wait(), 0) << world.errors();
  Program check{"trivela", {"keys", "check", "--dir", "keys"}, folder.path()};
  EXPECT_EQ(check.wait(), 0) << check.errors();
  EXPECT_THAT(check.output(), HasSubstr("robot 1: 17 identities, nothing wrong"));
  Program match{"trivela", with(short_match("match.db"), {"--secure", "./keys"}), folder.path()};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  std::filesystem::copy_file(folder / "keys/robot_1/identity_ca.pem", folder / "keys/robot_1/permissions_ca.pem",
                             std::filesystem::copy_options::overwrite_existing);
  Program refused{"trivela", with(short_match("no.db"), {"--secure", "./keys"}), folder.path()};
  EXPECT_EQ(refused.wait(), 2);
  EXPECT_THAT(refused.errors(), HasSubstr("CVE-2023-24011"));
  Program node{
      "trivela-odometry", {"--config", TRIVELA_SOURCE_DIR "/config/default.toml", "--secure", "keys"}, folder.path()};
  EXPECT_EQ(node.wait(), 1);
  EXPECT_THAT(node.errors(), HasSubstr("CVE-2023-24011"));
}

}  // namespace
}  // namespace trivela::e2e
