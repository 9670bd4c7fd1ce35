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
  file.model.decision.fire_weights = {0.1, -0.2, 0.3, -0.4, 0.5, -0.6};
  file.model.decision.threshold_ratio = 0.75;
  file.model.decision.opponent_places = true;
  file.model.decision.styles = 2;
  file.model.decision.style[1] = {.speed_ratio = 0.5, .side_ratio = 3.0, .brake_ratio = 1.5, .aim_ratio = 0.4};
  file.training = {"trivela study learn", "2015-04-13", {"ab.db"}, 70, 900, 10.0};
  file.held_out = {30, 400, 0.51, 0.52, -0.01, -0.02, -0.001, true};
  return file;
}

TEST_F(LearnedModelFiles, ReadBackTheSame) {
  const std::string text = to_toml_text(example());
  const LearnedModelFile again = load_learned_model(file("learned.toml", text));
  EXPECT_EQ(to_toml_text(again), text);
  EXPECT_EQ(again.model.weights, example().model.weights);
  EXPECT_EQ(again.model.decision.fire_weights, example().model.decision.fire_weights);
  EXPECT_EQ(again.model.decision.styles, 2u);
  EXPECT_TRUE(again.held_out.better);
}

TEST_F(LearnedModelFiles, WithoutADecisionChangeNothingOfIt) {
  const LearnedModelFile old = load_learned_model(file(
      "old.toml", to_toml_text(LearnedModelFile{}).substr(0, to_toml_text(LearnedModelFile{}).find("\n[decision]"))));
  EXPECT_EQ(to_toml_text(old), to_toml_text(LearnedModelFile{}));
}

TEST_F(LearnedModelFiles, OfABadDecisionAreRefusedWithTheKey) {
  const auto with = [&](const std::string& was, const std::string& now) {
    std::string text = to_toml_text(example());
    text.replace(text.find(was), was.size(), now);
    return [this, text] { load_learned_model(file("bad.toml", text)); };
  };
  EXPECT_THAT(with("threshold_ratio = 0.75", "threshold_ratio = nan"),
              ThrowsMessage<Error>(HasSubstr("decision.threshold_ratio")));
  EXPECT_THAT(with("threshold_ratio = 0.75", "treshold_ratio = 0.75"),
              ThrowsMessage<Error>(HasSubstr("treshold_ratio")));
  EXPECT_THAT(with("0.1, -0.2", "-0.2"), ThrowsMessage<Error>(HasSubstr("decision.fire_weights has 5 entries")));
  EXPECT_THAT(with("\"p_now\"", "\"p_then\""), ThrowsMessage<Error>(HasSubstr("decision.fire_features are not those")));
  std::string four;
  for (int i = 0; i < 4; ++i) four += "[[decision.style]]\n";
  EXPECT_THAT(with("[[decision.style]]", four + "[[decision.style]]"),
              ThrowsMessage<Error>(HasSubstr("6 of [[decision.style]], need 1 to 4")));
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
