#include "config/arms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "config/error.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ArmsFile : public testing::Test {
 protected:
  fs::path path = fs::temp_directory_path() / "trivela_arms_test.toml";
  void TearDown() override { fs::remove(path); }

  std::vector<ArmFields> read(const std::string& text) {
    std::ofstream{path} << text;
    return load_arms(path);
  }
  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(ArmsFile, NamesArmsWithWhatTheyChange) {
  const auto arms = read(
      "[[arm]]\nname = \"a\"\npolicy = \"predictive\"\ntable = \"old\"\nrobots = [\"r.toml\", \"/x/s.toml\"]\n"
      "set = [\"policy.settle_s = 0.5\"]\n"
      "[[arm]]\nname = \"b\"\nrandom = [\"stopped\", \"moving\"]\nrandom_probabilities = [0.25, 0.75]\n");
  ASSERT_EQ(arms.size(), 2u);
  EXPECT_EQ(arms[0].policy, kicking::PolicyName::kPredictive);
  EXPECT_EQ(arms[0].table, "old");
  EXPECT_EQ(arms[0].robots, (std::vector<std::string>{(path.parent_path() / "r.toml").string(), "/x/s.toml"}));
  EXPECT_EQ(arms[0].set, std::vector<std::string>{"policy.settle_s = 0.5"});
  EXPECT_EQ(arms[1].policy, kicking::PolicyName::kMoving);
  EXPECT_EQ(arms[1].random, (std::vector{kicking::PolicyName::kStopped, kicking::PolicyName::kMoving}));
  EXPECT_EQ(arms[1].random_probabilities, (std::vector{0.25, 0.75}));
}

TEST_F(ArmsFile, SaysWhatIsWrongWithOne) {
  EXPECT_THAT(complaint(""), HasSubstr("no [[arm]]"));
  EXPECT_THAT(complaint("[[arm]]\npolicy = \"moving\"\n"), HasSubstr(":1: arm.name"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\npolicy = \"walking\"\n"), HasSubstr("expected one of: stopped"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\ntable = \"worn\"\n"), HasSubstr("expected one of: new, old"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\nspeed = 3\n"), HasSubstr("unknown key"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\n[[arm]]\nname = \"a\"\n"), HasSubstr("twice"));
  EXPECT_THAT(complaint("seed = 3\n[[arm]]\nname = \"a\"\n"), HasSubstr("seed: unknown key"));
}

TEST(Arms, TheShippedFilesAreRead) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(TRIVELA_SOURCE_DIR "/config/arms")) {
    EXPECT_FALSE(load_arms(entry.path()).empty()) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace trivela::config
