#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/verbs.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/random_numbers.hpp"

namespace trivela::cli {
namespace {

using evaluator::LoggedKick;
using testing::HasSubstr;

class EvaluatePolicy : public evaluator::LogTest {
 protected:
  std::string output_of(const std::string& flags) {
    CLI::App app;
    int exit_code = -1;
    add_study(app, exit_code);
    testing::internal::CaptureStdout();
    try {
      app.parse("study evaluate-policy --all " + path().string() + " " + flags);
    } catch (const std::exception& error) {
      testing::internal::GetCapturedStdout();
      return error.what();
    }
    EXPECT_EQ(exit_code, kDone);
    return testing::internal::GetCapturedStdout();
  }

  // Matches of 60 possessions with the ball 3 to 6 m away; moving is drawn with `share`, 0 and 1 included, and more
  // often on target the nearer: 0.9 at 3 m to 0.6 at 6 m, 0.75 on average; stopped in 0.3 of them.
  void write(double share, std::uint32_t matches = 12) {
    evaluator::RandomNumbers random(6);
    evaluator::TestExperiment experiment(path(), matches);
    for (std::uint32_t match = 0; match < matches; ++match) {
      experiment.begin();
      experiment.session(match, 0, "", {}, false);
      for (std::int64_t i = 1; i <= 60; ++i) {
        const double distance_m = 3.0 + 3.0 * random.uniform();
        const bool moving = random.happens(share);
        const double p = moving ? 1.2 - 0.1 * distance_m : 0.3;
        const LoggedKick kick = random.happens(p) ? LoggedKick{"on_target", "on_target", distance_m}
                                                  : LoggedKick{"over", "over", distance_m};
        experiment.possession(1, i, moving ? "moving" : "stopped", moving ? share : 1.0 - share, kick,
                              9.0 - distance_m);
      }
      experiment.commit();
    }
    experiment.finish();
  }
};

TEST_F(EvaluatePolicy, ValuesAPolicyThatOnlyATenthOfThePossessionsHad) {
  write(0.1);
  const auto json = nlohmann::json::parse(output_of("--policy moving --json"));
  for (const char* const estimate : {"ips", "snips", "doubly_robust"}) {
    EXPECT_LT(json[estimate]["ci95"][0], 0.75) << estimate;
    EXPECT_GT(json[estimate]["ci95"][1], 0.75) << estimate;
  }
  EXPECT_NEAR(json["logged"].get<double>(), 0.345, 0.05);
  EXPECT_EQ(json["trials"], 720);
  EXPECT_NEAR(json["effective_sample_size"].get<double>(), json["by_policy"].get<double>(), 1e-9);
  EXPECT_NEAR(json["largest_weight"].get<double>(), 10.0, 1e-9);
  EXPECT_EQ(json["by_match"], true);
  EXPECT_EQ(json["model"], "true start");
  EXPECT_THAT(output_of("--policy moving"), HasSubstr("moving would have had a shot on target in"));
}

TEST_F(EvaluatePolicy, KnowsMoreWhereTheLogHasEveryCycle) {
  // All start alike; who gets near is on target, and only a decision that held says who got near.
  const auto doubly_robust = [&](bool every_cycle) {
    std::filesystem::remove(path());
    evaluator::RandomNumbers random(7);
    evaluator::TestExperiment experiment(path(), 12);
    for (std::uint32_t match = 0; match < 12; ++match) {
      experiment.begin();
      experiment.session(match, 0, "", {}, false);
      for (std::int64_t i = 1; i <= 60; ++i) {
        const bool near = random.happens(0.5);
        const bool moving = random.happens(0.25);
        const std::string policy = moving ? "moving" : "stopped";
        const double probability = moving ? 0.25 : 0.75;
        const std::string outcome = random.happens(near ? 0.95 : 0.05) ? "on_target" : "over";
        if (every_cycle) experiment.held(1, i, policy, probability, near ? 3.0 : 8.0);
        experiment.possession(1, i, policy, probability, LoggedKick{outcome, outcome, 3.0});
      }
      experiment.commit();
    }
    experiment.finish();
    return nlohmann::json::parse(output_of("--policy moving --json"));
  };
  const auto width = [](const nlohmann::json& json) {
    return json["doubly_robust"]["ci95"][1].get<double>() - json["doubly_robust"]["ci95"][0].get<double>();
  };
  const auto kicks_alone = doubly_robust(false), every_cycle = doubly_robust(true);
  EXPECT_EQ(kicks_alone["model"], "true start");
  EXPECT_EQ(every_cycle["model"], "first decision");
  EXPECT_EQ(kicks_alone["snips"], every_cycle["snips"]);
  EXPECT_LT(width(every_cycle), 0.75 * width(kicks_alone));
  EXPECT_LT(every_cycle["doubly_robust"]["ci95"][0], 0.5);
  EXPECT_GT(every_cycle["doubly_robust"]["ci95"][1], 0.5);
}

TEST_F(EvaluatePolicy, RefusesALogWhoseDecisionsWereCertain) {
  write(1.0);
  EXPECT_THAT(output_of("--policy moving"), HasSubstr("no policy was drawn at random"));
  EXPECT_THAT(output_of("--policy stopped"), HasSubstr("no overlap"));
}

TEST_F(EvaluatePolicy, RefusesAPolicyThatWasNeverDrawn) {
  write(0.5);
  EXPECT_THAT(output_of("--policy predictive"),
              HasSubstr("'predictive' was never drawn at random (no overlap); drawn were moving"));
}

TEST_F(EvaluatePolicy, RefusesTooFewEffectiveOpportunities) {
  write(0.1, 1);
  EXPECT_THAT(output_of("--policy moving"), HasSubstr("effective opportunities of 'moving' among 60"));
}

TEST_F(EvaluatePolicy, SaysThatFewMatchesAreTooFew) {
  write(0.5, 3);
  EXPECT_THAT(output_of("--policy moving"), HasSubstr("Fewer than five matches"));
}

TEST_F(EvaluatePolicy, NeedsAPolicyAndALog) {
  EXPECT_THAT(output_of(""), HasSubstr("--policy is required"));
  EXPECT_THAT(output_of("--policy moving"), HasSubstr("match.db"));
}

}  // namespace
}  // namespace trivela::cli
