// The rules by which the witness judges fires, on cases by hand. Times in ms where a number has no unit.
#include "tests/faults/fire_rules.hpp"

#include <gmock/gmock.h>

#include "tests/faults/forged_orders.hpp"

namespace trivela::faults {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

OrderSeen order(std::int64_t kick_id, std::int64_t t_ms, std::int64_t valid_ms = 50) {
  return {(t_ms + 1) * kMs, t_ms * kMs, kick_id, t_ms * kMs, (t_ms + valid_ms) * kMs};
}

FireSeen fire(std::int64_t kick_id, std::int64_t t_ms) { return {t_ms * kMs, t_ms * kMs, kick_id, false}; }

/// The referee lets play from 0 on and speaks each 20 ms, until `last_ms`.
std::vector<CommandSeen> playing_until(std::int64_t last_ms) {
  std::vector<CommandSeen> words;
  for (std::int64_t t_ms = 0; t_ms <= last_ms; t_ms += 20) words.push_back({t_ms * kMs, true});
  return words;
}

std::vector<Offence> offences(const Testimony& device, const Testimony& wire = {}, const FireRules& rules = {}) {
  std::vector<Offence> out;
  for (const Finding& finding : judge(device, wire, rules)) out.push_back(finding.offence);
  return out;
}

TEST(FireRules, AFreshOrderInPlayIsInOrder) {
  Testimony device;
  device.orders = {order(1, 1000), order(2, 1600)};
  device.fires = {fire(1, 1005), fire(2, 1605)};
  device.words = playing_until(2000);
  EXPECT_THAT(offences(device), IsEmpty());
}

TEST(FireRules, AFireNeedsAnOrderOfItsIdThatOneOfTheWitnessesSaw) {
  Testimony device, wire;
  device.words = playing_until(2000);
  device.fires = {fire(1, 1005)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kNoOrder));
  wire.orders = {order(1, 1000)};
  EXPECT_THAT(offences(device, wire), IsEmpty());
}

TEST(FireRules, AnUnauthorisedOrderIsNone) {
  constexpr std::int64_t kId = std::int64_t{0x7ffe} << 48 | 1;
  Testimony device;
  device.words = playing_until(2000);
  device.orders = {order(kId, 1000)};
  device.fires = {fire(kId, 1005)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kUnauthorised));
}

TEST(FireRules, AnOrderIsTooOldAfterItsValidityAndAtMostACycleIsAllowedToTheWire) {
  Testimony device;
  device.words = playing_until(2000);
  device.orders = {order(1, 1000, 50)};
  device.fires = {{1070 * kMs, 1050 * kMs, 1, false}};
  EXPECT_THAT(offences(device), IsEmpty());
  device.fires = {{1071 * kMs, 1050 * kMs, 1, false}};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kStale));
}

TEST(FireRules, AFarValidityDoesNotMakeAnOldOrderFresh) {
  Testimony device;
  device.words = playing_until(5000);
  device.orders = {order(1, 1000, 1'000'000)};
  device.fires = {fire(1, 1090)};
  EXPECT_THAT(offences(device), IsEmpty());
  device.fires = {fire(1, 1130)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kStale));
}

TEST(FireRules, AnInstantBeyondTheValidityIsTooLateWithoutAnyMargin) {
  Testimony device;
  device.words = playing_until(2000);
  device.orders = {order(1, 1000, 50)};
  device.fires = {{1010 * kMs, 1050 * kMs + 1, 1, false}};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kStale));
}

TEST(FireRules, OneOfTwoOrdersOfAnIdIsEnough) {
  Testimony device;
  device.words = playing_until(5000);
  device.orders = {order(1, 1000), order(1, 3000)};  // e.g. the first one with a bit turned over
  device.fires = {fire(1, 3010)};
  EXPECT_THAT(offences(device), IsEmpty());
}

TEST(FireRules, AnIdIsFiredOnce) {
  Testimony device;
  device.words = playing_until(3000);
  device.orders = {order(1, 1000, 1000)};
  device.fires = {fire(1, 1005), fire(1, 1095)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kTwice, Offence::kTooSoon));
}

TEST(FireRules, AStopThatTheDriverCouldKnowForbids) {
  Testimony device;
  device.orders = {order(1, 1000)};
  device.fires = {fire(1, 1030)};
  device.words = playing_until(1000);
  device.words.push_back({1015 * kMs, false});
  EXPECT_THAT(offences(device), IsEmpty()) << "the word came 15 ms before";
  device.words.back().arrival_ns = 1005 * kMs;
  EXPECT_THAT(offences(device), ElementsAre(Offence::kStopped));
  device.words.push_back({1025 * kMs, false});  // says so again: the stop is as old as before
  EXPECT_THAT(offences(device), ElementsAre(Offence::kStopped));
  device.words.push_back({1029 * kMs, true});
  EXPECT_THAT(offences(device), IsEmpty());
}

TEST(FireRules, ASilentRefereeForbidsAfterASecond) {
  Testimony device;
  device.words = playing_until(1000);
  device.orders = {order(1, 2000), order(2, 2600)};
  device.fires = {fire(1, 2019), fire(2, 2605)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kSilent));
  device.words.clear();
  EXPECT_THAT(offences(device), ElementsAre(Offence::kSilent, Offence::kSilent));
}

TEST(FireRules, TheIntervalHoldsForArrivalsWithAMarginAndForInstantsWithout) {
  Testimony device;
  device.words = playing_until(3000);
  device.orders = {order(1, 1000), order(2, 1470)};
  device.fires = {fire(1, 1000), {1481 * kMs, 1500 * kMs, 2, false}};
  EXPECT_THAT(offences(device), IsEmpty());
  device.fires[1] = {1479 * kMs, 1500 * kMs, 2, false};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kTooSoon));
  device.fires[1] = {1490 * kMs, 1500 * kMs - 1, 2, false};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kTooSoon));
}

TEST(FireRules, AKickThatIsCalledOffBeforeItsInstantIsNoFire) {
  Testimony device;
  device.words = playing_until(3000);
  device.orders = {order(1, 1000), order(2, 1100)};
  device.fires = {{1001 * kMs, 1020 * kMs, 1, false}, {1010 * kMs, 0, 1, true}, fire(2, 1101)};
  EXPECT_THAT(offences(device), IsEmpty());
  device.fires = {{1001 * kMs, 1020 * kMs, 1, false}, {1041 * kMs, 0, 1, true}, fire(2, 1101)};
  EXPECT_THAT(offences(device), ElementsAre(Offence::kTooSoon)) << "called off after it was carried out";
}

TEST(FireRules, AnIdThatTheWireTurnedIntoAnotherIsForged) {
  const std::int64_t id = 0x0102030405060708;
  const Finding finding{Offence::kNoOrder, fire(id, 2000), ""};
  const GarbledFrame frame{1990 * kMs, {0xaa, 8, 7, 6, 5, 4, 3, 2, 1, 0xaa}};
  EXPECT_TRUE(forged_by_the_wire(finding, {frame}));
  EXPECT_FALSE(forged_by_the_wire(finding, {{1990 * kMs, {8, 7, 6, 5, 4, 3, 2, 0}}})) << "another id";
  EXPECT_FALSE(forged_by_the_wire(finding, {{2010 * kMs, frame.bytes}})) << "it came after the fire";
  EXPECT_FALSE(forged_by_the_wire({Offence::kStale, finding.fire, ""}, {frame}));
  std::vector<Finding> findings{{Offence::kStopped, finding.fire, ""}, finding};
  EXPECT_EQ(take_forged(findings, {frame}).size(), 1u);
  EXPECT_EQ(findings.size(), 1u);
}

TEST(FireRules, TheSameFireSeenByBothWitnessesIsOne) {
  Testimony device, wire;
  device.words = playing_until(3000);
  device.orders = {order(1, 1000)};
  device.fires = {fire(1, 1005)};
  wire.fires = {{1007 * kMs, 1005 * kMs, 1, false}};
  EXPECT_THAT(offences(device, wire), IsEmpty());
  EXPECT_EQ(fires_carried_out(device, wire, {}).size(), 1u);
}

TEST(FireRules, ADeviceThatKicksLongAfterTheOrderIsLate) {
  Testimony device, wire;
  device.words = playing_until(3000);
  device.orders = {order(1, 1000)};
  device.fires = {fire(1, 1005)};
  wire.truths = {{4000 * kMs, 1350 * kMs, 1}};
  EXPECT_THAT(offences(device, wire), IsEmpty());
  wire.truths = {{4000 * kMs, 1351 * kMs, 1}};
  EXPECT_THAT(offences(device, wire), ElementsAre(Offence::kCarriedLate));
}

TEST(FireRules, ByArrivalsAloneTheStacksClockMayBeAnyone) {
  FireRules rules;
  rules.steady_t_ns = false;
  Testimony device;
  device.words = playing_until(3000);
  const auto foreign = [](std::int64_t kick_id, std::int64_t arrival_ms) {
    return OrderSeen{arrival_ms * kMs, 7 * kMs, kick_id, 7 * kMs, 57 * kMs};
  };
  device.orders = {foreign(1, 1000), foreign(2, 2000)};
  device.fires = {{1005 * kMs, 8 * kMs, 1, false}, {2005 * kMs, 8 * kMs, 2, false}};
  EXPECT_THAT(offences(device, {}, rules), IsEmpty());
  device.fires[1].arrival_ns = 2300 * kMs;
  EXPECT_THAT(offences(device, {}, rules), ElementsAre(Offence::kStale));
}

}  // namespace
}  // namespace trivela::faults
