#include <gmock/gmock.h>

#include <functional>

#include "nodes/kicker_driver/kicker_driver_node.hpp"
#include "tests/nodes/node_fixture.hpp"

namespace trivela::nodes {
namespace {

using bus::Executor;
using hal::ChargeCommand;

/// The driver of a kicker that can be told what its capacitor shall do.
class KickerCharge : public NodeTest {
 protected:
  KickerCharge() { kicker->can = {.charge_control = true, .voltage = true, .discharge = true, .watchdog = true}; }
  void start() {
    clock_ns = t_ns - 1'000'000'000;  // it has rested, whoever fired before it
    node.emplace(context, fake_kicker());
    clock_ns = t_ns;
    running.emplace(Executor::kListener, stop, std::vector<bus::Node*>{&node->node()});
    referee.expect_reader();
    decision.expect_reader();
  }
  msg::KickerStatus sample(double charge, double voltage_v) {
    clock_ns = t_ns += 20'000'000;
    msg::Referee word{};
    word.t_ns = t_ns;
    word.playing = true;
    referee(word);
    if (decides) decision({});
    kicker->put({.t_ns = t_ns, .charge = charge, .armed = true, .voltage_v = voltage_v});
    return status.nth(++samples);
  }
  /// Samples until `done` says so; false: it never does.
  bool goes_on_until(const std::function<bool(const msg::KickerStatus&)>& done, double charge, double voltage_v) {
    const auto deadline = std::chrono::steady_clock::now() + kPlenty;
    while (std::chrono::steady_clock::now() < deadline)
      if (done(sample(charge, voltage_v))) return true;
    return false;
  }

  std::int64_t t_ns = 1'000'000'000;
  std::size_t samples = 0;
  bool decides = true;  // a decision node is there
  Received<msg::KickerStatus> status{participant};
  Says<msg::Referee> referee{participant};
  Says<msg::DriveCommand> decision{participant, 1, "kick_decision/1"};
  std::optional<KickerDriverNode> node;
  std::optional<Running> running;
};

TEST_F(KickerCharge, IsToldWithEachSampleAndToEmptyWhenTheProgramEnds) {
  start();
  ASSERT_TRUE(goes_on_until([](const auto& s) { return s.state == msg::STATE_CHARGING; }, 0.2, 100.0));
  EXPECT_EQ(kicker->told, ChargeCommand::kCharge);
  EXPECT_EQ(sample(1.0, 300.0).state, msg::STATE_READY);
  running.reset();
  node.reset();
  EXPECT_EQ(kicker->told, ChargeCommand::kDischarge);
  EXPECT_TRUE(kicker->safe);
}

TEST_F(KickerCharge, IsEmptiedWhenTheDecisionNodeHasGone) {
  decides = false;
  Says<msg::DriveCommand> other{participant, 1, "somebody"};
  start();
  other.expect_reader();
  const auto drives = [](Says<msg::DriveCommand>& who, msg::KickerState wanted) {
    return [&who, wanted](const msg::KickerStatus& said) {
      who({});
      return said.state == wanted;
    };
  };
  ASSERT_TRUE(goes_on_until(drives(decision, msg::STATE_READY), 1.0, 300.0));
  EXPECT_TRUE(goes_on_until(drives(other, msg::STATE_OFF), 1.0, 300.0)) << "somebody else is no comfort";
  EXPECT_EQ(kicker->told, ChargeCommand::kDischarge);
  EXPECT_TRUE(log_lines->wait_for("the decision node is gone"));
  EXPECT_TRUE(goes_on_until(drives(decision, msg::STATE_READY), 1.0, 300.0)) << "it is back";
}

TEST_F(KickerCharge, IsNotToldToChargeBeforeADecisionNodeWasHeard) {
  decides = false;
  start();
  ASSERT_TRUE(goes_on_until([](const auto& s) { return s.armed; }, 0.2, 100.0));
  EXPECT_EQ(sample(1.0, 300.0).state, msg::STATE_OFF);
  EXPECT_EQ(kicker->told, ChargeCommand::kHold);
  decides = true;
  EXPECT_TRUE(goes_on_until([](const auto& s) { return s.state == msg::STATE_READY; }, 1.0, 300.0));
  EXPECT_EQ(kicker->told, ChargeCommand::kCharge);
}

TEST_F(KickerCharge, EndsWhereTheVoltageDoesNotRise) {
  start();
  ASSERT_TRUE(goes_on_until([](const auto& s) { return s.state == msg::STATE_CHARGING; }, 0.2, 100.0));
  ASSERT_TRUE(goes_on_until([](const auto& s) { return s.state == msg::STATE_FAULT; }, 0.2, 100.0));
  const msg::KickerStatus said = sample(0.2, 100.0);
  EXPECT_EQ(said.fault, msg::FAULT_CHARGER);
  EXPECT_EQ(said.voltage_v, 100.0);
  EXPECT_EQ(kicker->told, ChargeCommand::kHold);
}

TEST_F(KickerCharge, ADemandedCapabilityThatIsLackingIsRefused) {
  kicker->can = {.charge_control = false, .voltage = true, .discharge = false, .watchdog = true};
  context.settings.kicker_driver.demand = {config::Capability::kVoltage, config::Capability::kDischarge};
  KickerDriverNode driver{context, fake_kicker()};
  kicker->put({.t_ns = t_ns, .charge = 1.0, .armed = true, .voltage_v = 300.0});
  try {
    bus::Executor{Executor::kListener, stop, {&driver.node()}}.run();
    FAIL() << "it went on";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::StartsWith("kicker_driver.demand: the kicker "),
                                             testing::EndsWith(" has no discharge")));
  }
}

}  // namespace
}  // namespace trivela::nodes
