#include "config/kicker_state.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "config/text/error.hpp"
#include "tests/support/folder.hpp"

namespace trivela::config {
namespace {

using std::chrono::hours;
using testing::HasSubstr;

class KickerStateTest : public testing::Test {
 protected:
  kicking::KickerEstimate learned() const {
    kicking::KickerEstimate estimate;
    estimate.mean << 0.095, 0.01, -0.02, 0.005, -0.1, 0.05;
    estimate.se << 0.01, 0.004, 0.005, 0.003, 0.04, 0.05;
    estimate.speed_sd_ratio = 0.021;
    estimate.elevation_sd_rad = 0.003;
    estimate.direction_sd_rad = 0.03;
    estimate.delay_sd_s = 0.014;
    estimate.kicks = 31;
    return estimate;
  }
  std::optional<kicking::KickerEstimate> load(std::chrono::seconds later = std::chrono::seconds{0}) const {
    return load_kicker_state(file, robot, 2, 24.0, now + later);
  }
  std::string refusal(std::chrono::seconds later = std::chrono::seconds{0}) const {
    try {
      load(later);
    } catch (const Error& error) {
      return error.what();
    }
    return "it was taken";
  }

  tests::Folder folder;
  std::filesystem::path file = folder / "kicker.toml";
  Robot robot{};
  std::chrono::system_clock::time_point now = std::chrono::sys_days{std::chrono::year{2026} / 11 / 28};
};

TEST_F(KickerStateTest, ComesBackAsItWasLeft) {
  EXPECT_FALSE(load()) << "there is none yet";
  save_kicker_state(file, learned(), robot, 2, now);
  const auto state = load(hours{3});
  ASSERT_TRUE(state);
  EXPECT_EQ(state->mean, learned().mean);
  EXPECT_EQ(state->se, learned().se);
  EXPECT_EQ(state->speed_sd_ratio, learned().speed_sd_ratio);
  EXPECT_NEAR(state->elevation_sd_rad, learned().elevation_sd_rad, 1e-12);
  EXPECT_EQ(state->kicks, 31u);
}

TEST_F(KickerStateTest, IsReplacedWholeByTheNextOne) {
  save_kicker_state(file, learned(), robot, 2, now);
  kicking::KickerEstimate next = learned();
  next.kicks = 32;
  save_kicker_state(file, next, robot, 2, now);
  EXPECT_EQ(load()->kicks, 32u);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".new"));
}

TEST_F(KickerStateTest, AStaleOneAndOneOfTheFutureAreRefused) {
  save_kicker_state(file, learned(), robot, 2, now);
  EXPECT_THAT(refusal(hours{25}), HasSubstr("kicker.toml: is 25.0 h old, and self_calibration.state_max_age_h = 24"));
  EXPECT_THAT(refusal(hours{-2}), HasSubstr("is of 2.0 h from now: is the clock set?"));
}

TEST_F(KickerStateTest, OneOfAnotherRobotOrOfAnotherFileIsRefused) {
  save_kicker_state(file, learned(), robot, 5, now);
  EXPECT_THAT(refusal(), HasSubstr("is of robot 5 (cambada_1), and this is robot 2 (cambada_1)"));
  Robot other;
  other.model.delay_s += 0.001;
  save_kicker_state(file, learned(), other, 2, now);
  EXPECT_THAT(refusal(), HasSubstr("was learned with another file of the robot"));
}

TEST_F(KickerStateTest, ADamagedOneIsRefusedWithItsPlace) {
  save_kicker_state(file, learned(), robot, 2, now);
  std::string text{std::istreambuf_iterator<char>{std::ifstream{file}.rdbuf()}, {}};
  std::ofstream{file} << text.substr(0, text.find("means") + 9);
  EXPECT_THAT(refusal(), HasSubstr("kicker.toml:"));
  std::ofstream{file} << "";
  EXPECT_THAT(refusal(), HasSubstr("is of robot 0"));
  kicking::KickerEstimate wrong = learned();
  wrong.se[0] = -1.0;
  save_kicker_state(file, wrong, robot, 2, now);
  EXPECT_THAT(refusal(), HasSubstr("has numbers that no kicker has"));
}

TEST_F(KickerStateTest, AFolderThatCannotBeWrittenIsNamed) {
  try {
    save_kicker_state(folder / "none" / "kicker.toml", learned(), robot, 2, now);
    FAIL() << "it was written";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write"));
  }
}

}  // namespace
}  // namespace trivela::config
