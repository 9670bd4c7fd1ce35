#include "config/learned_model.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "config/settings.hpp"
#include "config/text/error.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class LearnedModelFiles : public testing::Test {
 protected:
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream{folder_ / name} << text;
    return folder_ / name;
  }

 private:
  tests::Folder folder_;
};

LearnedModelFile example() {
  LearnedModelFile file;
  file.model.intercept = -0.25;
  for (std::size_t i = 0; i < kicking::LearnedModel::kFeatures; ++i) {
    file.model.weights[i] = 0.1 * static_cast<double>(i);
    file.model.means[i] = 1.0 + static_cast<double>(i);
    file.model.scales[i] = 2.0;
  }
  file.training = {"trivela study learn", "2015-04-13", {"ab.db"}, 70, 900, 10.0};
  file.held_out = {30, 400, 0.51, 0.52, -0.01, -0.02, -0.001, true};
  return file;
}

TEST_F(LearnedModelFiles, ReadBackTheSame) {
  const std::string text = to_toml_text(example());
  const LearnedModelFile again = load_learned_model(file("learned.toml", text));
  EXPECT_EQ(to_toml_text(again), text);
  EXPECT_EQ(again.model.weights, example().model.weights);
  EXPECT_TRUE(again.held_out.better);
}

TEST_F(LearnedModelFiles, OfOtherFeaturesAreRefused) {
  std::string text = to_toml_text(example());
  text.replace(text.find("distance_m"), 10, "distance_x");
  EXPECT_THAT([&] { load_learned_model(file("learned.toml", text)); },
              ThrowsMessage<Error>(HasSubstr("model.features are not those of this program")));
  EXPECT_THAT([&] { load_learned_model(file("short.toml", "[model]\nweights = [1.0]\n")); },
              ThrowsMessage<Error>(HasSubstr("model.weights has 1 entries")));
}

TEST_F(LearnedModelFiles, GoWithTheSettingsThatNameThem) {
  file("learned.toml", to_toml_text(example()));
  const std::string learned = "[kick_decision]\npolicy_by_half = [\"learned\"]\n";
  const Settings settings = load_settings(file("with.toml", learned + "learned_model = \"learned.toml\"\n"));
  ASSERT_TRUE(settings.policy.learned);
  EXPECT_EQ(settings.policy.learned->intercept, -0.25);
  EXPECT_THAT([&] { load_settings(file("without.toml", learned)); },
              ThrowsMessage<Error>(HasSubstr("policy \"learned\" needs kick_decision.learned_model")));
  EXPECT_FALSE(load_settings(file("none.toml", "")).policy.learned);
}

}  // namespace
}  // namespace trivela::config
