#include "robot/observer/kick_learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class KickLearningTest : public testing::Test {
 protected:
  msg::KickDecision decided(std::int64_t kick_id, bool fire = true) const {
    msg::KickDecision decision{};
    decision.t_ns = 1'000'000'000 * kick_id;
    decision.kick_id = fire ? kick_id : 0;
    decision.fire = fire;
    decision.y_m = 3.0;
    return decision;
  }
  msg::KickReceipt answered(std::int64_t kick_id, bool accepted = true) const {
    msg::KickReceipt receipt{};
    receipt.kick_id = kick_id;
    receipt.accepted = accepted;
    receipt.order_t_ns = 1'000'000'000 * kick_id;
    receipt.fired_t_ns = receipt.order_t_ns;
    receipt.release_t_ns = receipt.order_t_ns + kicking::nanoseconds(model.delay_s);
    receipt.power = 30.0;
    return receipt;
  }
  /// A flight that is faster than the file by this factor.
  msg::KickOutcome flown(std::int64_t kick_id, double faster = 1.1) const {
    msg::KickOutcome outcome{};
    outcome.kick_id = kick_id;
    outcome.flight_speed_mps = faster * model.table.speed_for(30.0);
    outcome.flight_elevation_rad = model.exit_angle_rad;
    outcome.flight_direction_rad = 0.0;
    outcome.flight_sd_mps = 0.02;
    outcome.release_late_s = 0.0;
    return outcome;
  }

  kicking::RobotModel model{};
  config::SelfCalibration settings{};
  KickLearning learning{settings, model, 3};
};

TEST_F(KickLearningTest, BeginsWithTheFile) {
  const msg::KickerEstimate& first = learning.first();
  EXPECT_EQ(first.robot_id, 3);
  EXPECT_EQ(first.seq, 1u);
  EXPECT_EQ(first.kick_id, 0);
  EXPECT_EQ(first.speed_ln, 0.0);
  EXPECT_FALSE(first.used) << "the default is a shadow";
}

TEST_F(KickLearningTest, LearnsFromAKickInWhateverOrderItsMessagesCome) {
  learning.receive(answered(1));
  learning.receive(decided(1));
  const auto one = learning.seen(flown(1), 77);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->seq, 2u);
  EXPECT_EQ(one->t_ns, 77);
  EXPECT_EQ(one->kick_id, 1);
  EXPECT_EQ(one->kicks, 1u);
  EXPECT_GT(one->speed_ln, 0.05);
  EXPECT_LT(one->speed_ln_se, learning.first().speed_ln_se + 1e-12);
  learning.receive(decided(2));
  learning.receive(answered(2));
  EXPECT_EQ(learning.seen(flown(2), 78)->seq, 3u);
}

TEST_F(KickLearningTest, IsMovedByNoKickThatNobodySawOrGave) {
  learning.receive(decided(1));
  EXPECT_FALSE(learning.seen(flown(1), 1)) << "no receipt";
  learning.receive(answered(1, false));
  EXPECT_FALSE(learning.seen(flown(1), 1)) << "refused";
  learning.receive(answered(1));
  msg::KickOutcome unseen = flown(1);
  unseen.flight_speed_mps = kNaN;
  EXPECT_FALSE(learning.seen(unseen, 1)) << "no flight";
  EXPECT_FALSE(learning.seen(flown(9), 1)) << "another kick";
  learning.receive(decided(5, false));
  EXPECT_FALSE(learning.seen(flown(0), 1)) << "a decision that held";
  msg::KickReceipt flat = answered(6);
  flat.kick_kind = 1;
  learning.receive(decided(6));
  learning.receive(flat);
  EXPECT_FALSE(learning.seen(flown(6), 1)) << "a further kind of kick";
}

TEST_F(KickLearningTest, ASecondOutcomeOfAKickSaysNothingNew) {
  learning.receive(decided(1));
  learning.receive(answered(1));
  EXPECT_TRUE(learning.seen(flown(1), 1));
  EXPECT_FALSE(learning.seen(flown(1), 2));
}

TEST_F(KickLearningTest, KeepsNoMoreKicksThanMayBeOpen) {
  for (int i = 1; i <= 100; ++i) {
    learning.receive(decided(i));
    learning.receive(answered(i));
  }
  EXPECT_FALSE(learning.seen(flown(1), 1));
  EXPECT_TRUE(learning.seen(flown(100), 1));
}

TEST_F(KickLearningTest, ItsMessageIsItsEstimate) {
  learning.receive(decided(1));
  learning.receive(answered(1));
  const auto message = learning.seen(flown(1), 1);
  ASSERT_TRUE(message);
  const kicking::KickerEstimate estimate = estimate_of(*message);
  EXPECT_EQ(estimate.mean[kicking::kSpeedPart], message->speed_ln);
  EXPECT_EQ(estimate.se[kicking::kSidewaysPart], message->sideways_se_ratio);
  EXPECT_EQ(estimate.delay_sd_s, message->delay_sd_s);
  KickLearning next{settings, model, 3};
  next.begin_with(estimate);
  EXPECT_NEAR(next.first().speed_ln, message->speed_ln, 1e-12);
  EXPECT_EQ(next.first().seq, 1u);
  EXPECT_GT(next.first().speed_ln_se, message->speed_ln_se);
}

}  // namespace
}  // namespace trivela::robot
