#include "config/arms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "config/text/error.hpp"

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
  ASSERT_EQ(arms[0].set.size(), 1u);
  EXPECT_EQ(arms[0].set[0].text, "policy.settle_s = 0.5");
  EXPECT_EQ(arms[0].set[0].place, path.string() + ":6: arm a: set \"policy.settle_s = 0.5\"");
  EXPECT_EQ(arms[1].place, path.string() + ":7: arm b");
  EXPECT_EQ(arms[1].policy, std::nullopt);
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

TEST_F(ArmsFile, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\npolicy = \"moving\"\ntable = \"older\"\n"),
              HasSubstr("arms_test.toml:4: arm.table = \"older\""));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\nrandom = [\"moving\", \"stopped\"]\n"
                        "random_probabilities = [0.5, 0.25]\n"),
              HasSubstr("arms_test.toml:4: arm a: kick_decision.random_probabilities = [0.5, 0.25] sum up to 0.75"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\nrandom = [\"moving\", \"moving\"]\n"),
              HasSubstr("arms_test.toml:3: arm a: kick_decision.random names \"moving\" twice"));
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\n[[arm]]\nname = \"b\"\n[[arm]]\nname = \"a\"\n"),
              HasSubstr("arms_test.toml:6: arm.name = \"a\" stands there twice"));
}

TEST_F(ArmsFile, PolicyAndRandomTogetherAreRefused) {
  EXPECT_THAT(complaint("[[arm]]\nname = \"a\"\nrandom = [\"moving\", \"stopped\"]\npolicy = \"moving\"\n"),
              HasSubstr("arms_test.toml:4: arm a: policy = \"moving\" says who plays, and so does the arm's random"));
}

TEST_F(ArmsFile, ANameIsPrintableAndShort) {
  const auto named = [](const std::string& name) { return "[[arm]]\npolicy = \"moving\"\nname = \"" + name + "\"\n"; };
  EXPECT_THAT(complaint(named("")), HasSubstr("arms_test.toml:3: arm.name = \"\": an arm needs a name"));
  EXPECT_THAT(complaint(named("a\\u001b[31m")),
              HasSubstr("arms_test.toml:3: arm.name = \"a\\x1b[31m\": has a control"));
  EXPECT_THAT(complaint(named("two\\nlines")), HasSubstr("\"two\\x0alines\": has a control"));
  EXPECT_THAT(complaint(named("\\u0085")), HasSubstr("\"\\xc2\\x85\": has a control"));
  EXPECT_THAT(complaint(named(std::string(65, 'x'))), HasSubstr("has 65 bytes, and 64 at most"));
  EXPECT_EQ(read(named(std::string(64, 'x')))[0].name.size(), 64u);
  EXPECT_EQ(read(named("flach, \u00a0\u00fcber 0.5 \u26bd"))[0].name, "flach, \u00a0\u00fcber 0.5 \u26bd");
}

TEST(SettingLines, NameTheirKeysAndTheirPlace) {
  Settings settings;
  EXPECT_THAT(override_setting(settings, SettingLine{"policy.predictive.threshold = 0.6", "here"}),
              testing::ElementsAre("policy.predictive.threshold"));
  EXPECT_EQ(settings.policy.predictive.threshold, 0.6);
  EXPECT_THAT(override_setting(settings, SettingLine{"run = {robot_id = 2, session = 3}", "here"}),
              testing::ElementsAre("run.robot_id", "run.session"));
  const auto said = [&](const std::string& text) {
    try {
      override_setting(settings, SettingLine{text, "arms.toml:3: arm a"});
    } catch (const Error& error) {
      return std::string{error.what()};
    }
    return std::string{"nothing"};
  };
  EXPECT_EQ(said("policy.foo = 3"), "arms.toml:3: arm a: policy.foo: unknown key");
  EXPECT_EQ(said("policy.settle_s = -1.0"), "arms.toml:3: arm a: policy.settle_s = -1.0: must lie in [0, 5]");
  EXPECT_THAT(said("policy.settle_s"), HasSubstr("arms.toml:3: arm a: not valid TOML"));
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
