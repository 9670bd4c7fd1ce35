#include "kicking/model/omni_kinematics.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "kicking/geometry/angle.hpp"
#include "tests/robot/wheel_speeds.hpp"

namespace trivela::kicking {
namespace {

using robot::wheel_speeds_radps;
using ::testing::HasSubstr;

const WheelBase kThree{};
const WheelBase kFour{{radians(45), radians(135), radians(225), radians(315)}, 0.25, 0.04};

// Wheels at 0, 90, 180 and 270 degrees push along +y, -x, -y and +x.
TEST(OmniKinematics, GivesEachWheelItsShareOfTheMotionByHand) {
  const auto w = wheel_speeds_radps({{0.0, radians(90), radians(180), radians(270)}, 0.2, 0.05}, {0.3, 1.0, 2.0});
  ASSERT_EQ(w.size(), 4u);
  EXPECT_NEAR(w[0], (1.0 + 0.4) / 0.05, 1e-12);
  EXPECT_NEAR(w[1], (-0.3 + 0.4) / 0.05, 1e-12);
  EXPECT_NEAR(w[2], (-1.0 + 0.4) / 0.05, 1e-12);
  EXPECT_NEAR(w[3], (0.3 + 0.4) / 0.05, 1e-12);
}

TEST(OmniKinematics, TwistUndoesWheelSpeeds) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> speed{-3.0, 3.0};
  for (const auto& base : {kThree, kFour}) {
    const OmniKinematics kinematics{base};
    EXPECT_EQ(kinematics.wheel_count(), static_cast<int>(base.wheel_angles_rad.size()));
    for (int i = 0; i < 200; ++i) {
      const Twist twist{speed(random), speed(random), speed(random)};
      const Twist back = kinematics.twist(wheel_speeds_radps(base, twist));
      EXPECT_NEAR(back.vx_mps, twist.vx_mps, 1e-12);
      EXPECT_NEAR(back.vy_mps, twist.vy_mps, 1e-12);
      EXPECT_NEAR(back.omega_radps, twist.omega_radps, 1e-12);
    }
  }
}

TEST(OmniKinematics, TurnsAMotionIntoTheSpeedsThatTheEquationGives) {
  const Twist twist{0.5, -1.5, 2.0};
  for (const auto& base : {kThree, kFour}) {
    const auto speeds = OmniKinematics{base}.wheel_speeds_radps(twist);
    const auto expected = wheel_speeds_radps(base, twist);
    for (std::size_t i = 0; i < speeds.size(); ++i) EXPECT_NEAR(speeds[i], i < expected.size() ? expected[i] : 0, 1e-12);
  }
}

TEST(OmniKinematics, AFourthWheelSpreadsAnErrorInsteadOfPassingItOn) {
  const OmniKinematics kinematics{kFour};
  auto w = wheel_speeds_radps(kFour, {0.0, 1.0, 0.0});
  w[0] += 4.0;  // slips
  const Twist twist = kinematics.twist(w);
  // Each wheel's quarter: 4 rad/s * 0.04 m / 4 over the lever.
  EXPECT_NEAR(twist.omega_radps, 0.04 / 0.25, 1e-12);
  EXPECT_NEAR(std::hypot(twist.vx_mps, twist.vy_mps - 1.0), 4.0 * 0.04 / 2.0, 1e-12);
}

TEST(OmniKinematics, TwistVarianceIsWhatNoisyWheelsScatter) {
  std::mt19937_64 random{11};
  std::normal_distribution<double> noise{0.0, 0.7};
  constexpr int kRuns = 20000;
  for (const auto& base : {kThree, kFour}) {
    const OmniKinematics kinematics{base};
    const auto still = wheel_speeds_radps(base, {0.5, -0.2, 1.0});
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    for (int i = 0; i < kRuns; ++i) {
      auto w = still;
      for (double& speed : w) speed += noise(random);
      const Twist twist = kinematics.twist(w);
      squares +=
          Eigen::Vector3d{twist.vx_mps - 0.5, twist.vy_mps + 0.2, twist.omega_radps - 1.0}.array().square().matrix();
    }
    const Eigen::Vector3d expected = kinematics.twist_variance(0.7);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis] / kRuns / expected[axis], 1.0, 0.04) << axis;
  }
}

std::string refusal(const WheelBase& base) {
  try {
    const OmniKinematics kinematics{base};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OmniKinematics, RefusesABaseThatCannotDriveAndNamesTheValue) {
  EXPECT_THAT(refusal({{0.0, 1.0}, 0.2, 0.05}), HasSubstr("not 2"));
  EXPECT_THAT(refusal({{0.0, 1.0, 2.0, 3.0, 4.0}, 0.2, 0.05}), HasSubstr("not 5"));
  EXPECT_THAT(refusal({kThree.wheel_angles_rad, 0.2, 0.0}), HasSubstr("wheel radius 0 m"));
  EXPECT_THAT(refusal({kThree.wheel_angles_rad, -0.25, 0.05}), HasSubstr("distance -0.25 m"));
  EXPECT_THAT(refusal({kThree.wheel_angles_rad, std::nan(""), 0.05}), HasSubstr("distance nan m"));
  EXPECT_THAT(refusal({{0.3, 0.3, 0.3}, 0.2, 0.05}), HasSubstr("do not span the plane"));
  EXPECT_EQ(refusal(kFour), "accepted");
}

}  // namespace
}  // namespace trivela::kicking
