// Two nodes of one kind and robot would both write; the second is turned away.
#include "nodes/kick_decision/kick_decision_node.hpp"
#include "nodes/kicker_drift/kicker_drift_node.hpp"
#include "nodes/kicker_driver/kicker_driver_node.hpp"
#include "nodes/odometry/odometry_node.hpp"
#include "nodes/shot_observer/shot_observer_node.hpp"
#include "nodes/world_state/world_state_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TwinsTest : public NodeTest {
 protected:
  /// Makes a node twice and expects the second to be refused with its name and topic, but not one of another robot.
  template <class Make>
  void expect_refused(Make make, const std::string& name, const std::string& topic) {
    const auto first = make(context);
    NodeContext other{context.settings, context.robot, participant, context.logger, stop};
    other.settings.run.robot_id = 2;
    EXPECT_NO_THROW(make(other));
    try {
      make(context);
      FAIL() << "there are two of " << name;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("another " + name + " of robot 1"), HasSubstr("writes " + topic),
                                      HasSubstr("domain " + std::to_string(domain.domain_id))));
    }
  }
};

TEST_F(TwinsTest, OfOdometryAreRefused) {
  expect_refused([this](NodeContext& c) { return std::make_unique<OdometryNode>(c, fake_wheels()); }, "odometry",
                 "odometry");
}

TEST_F(TwinsTest, OfWorldStateAreRefused) {
  expect_refused([](NodeContext& c) { return std::make_unique<WorldStateNode>(c); }, "world_state", "world_state");
}

TEST_F(TwinsTest, OfKickDecisionAreRefused) {
  expect_refused([](NodeContext& c) { return std::make_unique<KickDecisionNode>(c); }, "kick_decision", "kick_order");
}

TEST_F(TwinsTest, OfTheKickerDriverAreRefused) {
  expect_refused([this](NodeContext& c) { return std::make_unique<KickerDriverNode>(c, fake_kicker()); },
                 "kicker_driver", "kick_receipt");
}

TEST_F(TwinsTest, OfTheShotObserverAreRefused) {
  expect_refused([](NodeContext& c) { return std::make_unique<ShotObserverNode>(c); }, "shot_observer", "kick_outcome");
}

TEST_F(TwinsTest, OfKickerDriftAreRefused) {
  expect_refused([](NodeContext& c) { return std::make_unique<KickerDriftNode>(c); }, "kicker_drift", "kicker_drift");
}

}  // namespace
}  // namespace trivela::nodes
