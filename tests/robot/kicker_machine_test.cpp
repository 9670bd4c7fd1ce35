#include "robot/driver/kicker_machine.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <random>
#include <regex>
#include <string>

#include "robot/driver/kicker_controller.hpp"
#include "tests/instants.hpp"

namespace trivela::robot {
namespace {

using enum KickerEvent;
using hal::ChargeCommand;

constexpr std::array kStates{msg::STATE_OFF,    msg::STATE_CHARGING, msg::STATE_READY,
                             msg::STATE_FIRING, msg::STATE_COOLING,  msg::STATE_FAULT};

const char* name(KickerEvent event) {
  switch (event) {
    case kArmed:
      return "armed";
    case kDisarmed:
      return "disarmed";
    case kCharged:
      return "charged";
    case kUncharged:
      return "not charged";
    case kAccepted:
      return "order accepted";
    case kCalledOff:
      return "order called off";
    case kShotOver:
      return "shot over";
    case kRested:
      return "rested";
    case kFault:
      return "fault";
    case kOverVoltage:
      return "over-voltage";
    case kHealthy:
      return "healthy";
    case kDecisionLost:
      return "decision node lost";
    case kEnd:
      return "program ends";
  }
  return "";
}

const char* name(ChargeCommand word) {
  return word == ChargeCommand::kCharge ? "charge" : word == ChargeCommand::kDischarge ? "empty" : "hold";
}

/// A cell of docs/kicker.md: "charging, charge"; "-": nothing changes.
std::string cell(KickerMachineState from, KickerMachineState to) {
  return from == to ? "-" : std::string(bus::label(to.state)) + ", " + name(to.word);
}

/// The stand in which a state is at first.
KickerMachineState first(msg::KickerState state) {
  const bool up = state != msg::STATE_OFF && state != msg::STATE_FAULT;
  return {state, up ? ChargeCommand::kCharge : ChargeCommand::kHold};
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  const std::regex between(R"(\s*\|\s*)");
  for (std::sregex_token_iterator at(line.begin(), line.end(), between, -1), end; at != end; ++at) {
    if (!at->str().empty()) cells.push_back(at->str());
  }
  return cells;
}

/// The table of docs/kicker.md, by event.
std::map<std::string, std::vector<std::string>> table() {
  std::map<std::string, std::vector<std::string>> rows;
  std::ifstream page(TRIVELA_SOURCE_DIR "/docs/kicker.md");
  for (std::string line; std::getline(page, line);) {
    const auto cells = cells_of(line);
    if (cells.size() == kStates.size() + 1) rows[cells.front()] = {cells.begin() + 1, cells.end()};
  }
  return rows;
}

struct Case {
  KickerEvent event;
  std::size_t state;  // in kStates
};

class KickerMachine : public testing::TestWithParam<Case> {};

TEST_P(KickerMachine, DoesWhatTheTableOfItsPageSays) {
  const auto rows = table();
  const auto row = rows.find(name(GetParam().event));
  ASSERT_NE(row, rows.end()) << "no row of " << name(GetParam().event);
  const KickerMachineState from = first(kStates[GetParam().state]);
  EXPECT_EQ(row->second[GetParam().state], cell(from, next(from, GetParam().event)));
}

std::vector<Case> every_case() {
  std::vector<Case> cases;
  for (const KickerEvent event : kKickerEvents) {
    for (std::size_t state = 0; state < kStates.size(); ++state) cases.push_back({event, state});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Every, KickerMachine, testing::ValuesIn(every_case()), [](const auto& of) {
  const std::string text = std::string(bus::label(kStates[of.param.state])) + "_" + name(of.param.event);
  return std::regex_replace(text, std::regex("[^a-z]"), "_");
});

TEST(KickerMachineOverTime, ChargesInNoStateButThoseThatAreArmed) {
  std::mt19937 random(3);
  KickerMachineState stand;
  for (int i = 0; i < 100'000; ++i) {
    const KickerEvent event = kKickerEvents[random() % kKickerEvents.size()];
    const KickerMachineState before = stand;
    stand = next(stand, event);
    const bool armed = stand.state != msg::STATE_OFF && stand.state != msg::STATE_FAULT;
    ASSERT_EQ(stand.word == ChargeCommand::kCharge, armed);
    const bool fires = stand.state == msg::STATE_FIRING && before.state != msg::STATE_FIRING;
    ASSERT_TRUE(!fires || (before.state == msg::STATE_READY && event == kAccepted));
    const bool no_more_emptied = before.word == ChargeCommand::kDischarge && stand.word != ChargeCommand::kDischarge;
    ASSERT_TRUE(!no_more_emptied || event == kArmed || event == kFault);
  }
}

hal::KickerSample measured(std::int64_t t_ns, double voltage_v, bool armed = true) {
  return {.t_ns = t_ns, .charge = 0.1, .armed = armed, .voltage_v = voltage_v};
}

TEST(VoltageWatch, FindsACapacitorThatIsChargedAndDoesNotRise) {
  VoltageWatch watch{5.0, 1.0};
  EXPECT_FALSE(watch.stuck(measured(0, 100.0), true));
  EXPECT_FALSE(watch.stuck(measured(1000 * kMs, 104.9), true));
  EXPECT_TRUE(watch.stuck(measured(1001 * kMs, 104.9), true));
  EXPECT_TRUE(watch.stuck(measured(1002 * kMs, 200.0), false)) << "until somebody has looked";
  EXPECT_FALSE(watch.stuck(measured(1003 * kMs, 100.0, false), false)) << "and opened the switch";
}

TEST(VoltageWatch, LeavesOneThatRisesOrIsNotChargedOrNotMeasured) {
  VoltageWatch watch{5.0, 1.0};
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.stuck(measured(i * 900 * kMs, 10.0 + 5.0 * i), true));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.stuck(measured(i * 900 * kMs, 10.0), false));
  const hal::KickerSample modelled{.charge = 0.1, .armed = true, .charge_modelled = true};
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.stuck(modelled, true));
}

class ControllerOfSomeCapabilities : public testing::TestWithParam<int> {
 protected:
  hal::KickerCapabilities can() const {
    return {.charge_control = (GetParam() & 1) != 0,
            .voltage = (GetParam() & 2) != 0,
            .discharge = (GetParam() & 4) != 0,
            .watchdog = (GetParam() & 8) != 0};
  }
  hal::KickerSample sample(double charge, double voltage_v, bool armed = true) const {
    hal::KickerSample out{.t_ns = now_ns, .charge = charge, .armed = armed, .charge_modelled = !can().voltage};
    if (can().voltage) out.voltage_v = voltage_v;
    return out;
  }
  msg::KickerStatus at(std::int64_t t_ms, double charge, double voltage_v,
                       RefereePermission says = RefereePermission::kPlay) {
    now_ns = t_ms * kMs;
    return desk.status(sample(charge, voltage_v), says, now_ns);
  }
  msg::Refusal order(std::int64_t kick_id) {
    msg::KickOrder wish{};
    wish.t_ns = wish.fire_t_ns = now_ns;
    wish.valid_until_t_ns = now_ns + 50 * kMs;
    wish.kick_id = kick_id;
    wish.power = 25.0;
    wish.possession = true;
    return desk.answer(wish, now_ns, OrderBy::kOwnDecision).refusal;
  }

  KickerController desk{{}, 0.02, {}, 1, DecisionNode::kThere};
  std::int64_t now_ns = 0;
};

TEST_P(ControllerOfSomeCapabilities, GoesThroughAKick) {
  EXPECT_EQ(at(1000, 0.2, 100.0, RefereePermission::kStop).state, msg::STATE_OFF);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kHold);
  EXPECT_EQ(at(1020, 0.2, 100.0).state, msg::STATE_CHARGING);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kCharge);
  EXPECT_EQ(order(1), msg::REFUSAL_CHARGING);
  EXPECT_EQ(at(1040, 1.0, 300.0).state, msg::STATE_READY);
  EXPECT_EQ(order(2), msg::REFUSAL_NONE);
  EXPECT_EQ(at(1060, 0.1, 90.0).state, msg::STATE_FIRING);
  EXPECT_EQ(at(1100, 0.2, 120.0).state, msg::STATE_COOLING);
  EXPECT_EQ(order(3), msg::REFUSAL_DOUBLE);
  EXPECT_EQ(at(1560, 1.0, 300.0).state, msg::STATE_READY);
}

TEST_P(ControllerOfSomeCapabilities, IsNotReadyBeforeItHasRestedThoughAStopLedPastCooling) {
  at(1000, 1.0, 300.0);
  EXPECT_EQ(order(1), msg::REFUSAL_NONE);
  EXPECT_EQ(at(1020, 1.0, 300.0, RefereePermission::kStop).state, msg::STATE_OFF);
  EXPECT_EQ(at(1040, 1.0, 300.0).state, msg::STATE_CHARGING) << "its pulse may run";
  EXPECT_EQ(at(1100, 1.0, 300.0).state, msg::STATE_CHARGING) << "not at rest";
  EXPECT_EQ(order(2), msg::REFUSAL_DOUBLE);
  EXPECT_EQ(at(1500, 1.0, 300.0).state, msg::STATE_READY);
  EXPECT_EQ(order(3), msg::REFUSAL_NONE);
}

TEST_P(ControllerOfSomeCapabilities, EmptiesWhereTheDecisionNodeIsGoneOrTheProgramEnds) {
  at(1000, 1.0, 300.0);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kCharge);
  desk.decision_node(DecisionNode::kLost, now_ns);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kDischarge);
  EXPECT_EQ(at(1020, 0.9, 290.0).state, msg::STATE_OFF);
  desk.decision_node(DecisionNode::kThere, now_ns);
  EXPECT_EQ(at(1040, 1.0, 300.0).state, msg::STATE_READY);
  EXPECT_EQ(desk.end(), ChargeCommand::kDischarge);
}

TEST_P(ControllerOfSomeCapabilities, IsNotChargedBeforeADecisionNodeWasHeard) {
  desk = KickerController{{}, 0.02, {}, 1};
  EXPECT_EQ(at(1000, 1.0, 300.0).state, msg::STATE_OFF);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kHold);
  desk.decision_node(DecisionNode::kUnheard, now_ns);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kHold) << "what never came is not missed";
  desk.decision_node(DecisionNode::kThere, now_ns);
  EXPECT_EQ(desk.charge_command(), ChargeCommand::kCharge);
}

TEST_P(ControllerOfSomeCapabilities, DoubtsAVoltageWhereItIsMeasured) {
  for (std::int64_t t_ms = 0; t_ms <= 1100; t_ms += 20) at(t_ms, 0.2, 100.0);
  const msg::KickerStatus said = at(1120, 0.2, 100.0);
  EXPECT_EQ(said.state, can().voltage ? msg::STATE_FAULT : msg::STATE_CHARGING);
  EXPECT_EQ(said.fault, can().voltage ? msg::FAULT_CHARGER : msg::FAULT_NONE);
  EXPECT_EQ(desk.charge_command(), can().voltage ? ChargeCommand::kHold : ChargeCommand::kCharge);
  EXPECT_EQ(said.charge_modelled, !can().voltage);
}

TEST_P(ControllerOfSomeCapabilities, EmptiesAtOverVoltage) {
  at(1000, 1.0, 300.0);
  const msg::KickerStatus said = at(1020, 1.2, 340.0);
  EXPECT_EQ(said.state, can().voltage ? msg::STATE_FAULT : msg::STATE_CHARGING);
  EXPECT_EQ(desk.charge_command(), can().voltage ? ChargeCommand::kDischarge : ChargeCommand::kCharge);
  EXPECT_EQ(order(1), can().voltage ? msg::REFUSAL_FAULT : msg::REFUSAL_CHARGING);
  EXPECT_EQ(at(1040, 1.0, 300.0).state, can().voltage ? msg::STATE_FAULT : msg::STATE_READY)
      << "a charger that runs away";
  now_ns = 1060 * kMs;
  desk.status(sample(1.0, 300.0, false), RefereePermission::kPlay, now_ns);
  EXPECT_EQ(at(1080, 1.0, 300.0).state, msg::STATE_READY) << "somebody has looked";
}

TEST_P(ControllerOfSomeCapabilities, IsRefusedWhereOneThatItLacksIsDemanded) {
  using config::Capability;
  const std::vector<std::pair<Capability, bool>> all{{Capability::kChargeControl, can().charge_control},
                                                     {Capability::kVoltage, can().voltage},
                                                     {Capability::kDischarge, can().discharge},
                                                     {Capability::kWatchdog, can().watchdog}};
  EXPECT_EQ(missing({}, can()), "");
  for (const auto& [capability, has] : all) EXPECT_EQ(missing({capability}, can()).empty(), has);
}

INSTANTIATE_TEST_SUITE_P(Each, ControllerOfSomeCapabilities, testing::Range(0, 16));

TEST(KickerController, AcceptsNoOrderButInReady) {
  std::mt19937 random(5);
  config::KickerDriver settings;
  settings.min_interval_s = 0.02;
  KickerController desk{settings, 0.02, {}, 1, DecisionNode::kThere};
  std::int64_t now_ns = 0;
  int accepted = 0;
  for (std::int64_t id = 1; id < 20'000; ++id) {
    now_ns += static_cast<std::int64_t>(random() % 30) * kMs;
    const hal::KickerSample sample{.t_ns = now_ns - static_cast<std::int64_t>(random() % 2) * 90 * kMs,
                                   .charge = random() % 4 == 0 ? 0.5 : 1.0,
                                   .armed = random() % 8 != 0,
                                   .fault = random() % 16 == 0 ? hal::KickerFault::kCoil : hal::KickerFault::kNone};
    const bool stops = random() % 8 == 0;
    const auto status = desk.status(sample, stops ? RefereePermission::kStop : RefereePermission::kPlay, now_ns);
    EXPECT_EQ(status.ready, status.state == msg::STATE_READY);
    msg::KickOrder wish{};
    wish.t_ns = wish.fire_t_ns = now_ns;
    wish.valid_until_t_ns = now_ns + 50 * kMs;
    wish.kick_id = id;
    wish.power = 25.0;
    wish.possession = true;
    const bool taken = desk.answer(wish, now_ns, OrderBy::kOwnDecision).accepted;
    accepted += taken ? 1 : 0;
    EXPECT_EQ(taken, status.ready);
  }
  EXPECT_GT(accepted, 1000);
}

}  // namespace
}  // namespace trivela::robot
