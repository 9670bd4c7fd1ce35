// The client of a referee box on real sockets, with an emulated box and with none.
#include <gmock/gmock.h>

#include "tests/hal/refbox_link.hpp"

namespace trivela::hal::refbox {
namespace {

using testing::HasSubstr;
using tests::BoxLink;
using tests::kBoxTimeout;
using tests::kWorldstate;
using Clock = std::chrono::steady_clock;

TEST(RefboxClient, HearsCommandsOfBothTeamsAndOfOurs) {
  BoxLink link;
  link.meet();
  link.say(CommandKind::kKickOff, 0);
  EXPECT_EQ(link.next<Command>(), (Command{CommandKind::kKickOff, Side::kOurs, {}}));
  link.say(CommandKind::kGoal, 1);
  EXPECT_EQ(link.next<Command>(), (Command{CommandKind::kGoal, Side::kTheirs, {}}));
  link.box.act(BoxCommand{CommandKind::kSubstitution, 0, 4});
  EXPECT_EQ(link.next<Command>(), (Command{CommandKind::kSubstitution, Side::kOurs, 4}));
  link.say(CommandKind::kStart);
  EXPECT_EQ(link.next<Command>(), (Command{CommandKind::kStart, Side::kBoth, {}}));
}

TEST(RefboxClient, HearsTheLettersOfAnOlderBox) {
  BoxLink link{{.protocol = Protocol::kLetters}};
  link.meet();
  for (const CommandKind kind : {CommandKind::kKickOff, CommandKind::kStart, CommandKind::kStop, CommandKind::kGoal}) {
    link.say(kind,
             kind == CommandKind::kStart || kind == CommandKind::kStop ? std::nullopt : std::optional<std::size_t>{0});
    EXPECT_EQ(link.command(), kind);
  }
}

TEST(RefboxClient, LosesABoxThatSpeaksObjectsWhereLettersAreHeard) {
  BoxLink link{{.protocol = Protocol::kLetters}};
  link.meet();
  link.box.act(BoxFault::kStatus);
  EXPECT_THAT(link.next<Lost>().value_or(Lost{}).why, HasSubstr("refbox.letters = false"));
}

TEST(RefboxClient, MergedAndHalvedObjectsAreWhole) {
  BoxLink link;
  link.meet();
  link.box.act(BoxFault::kMerge);
  link.say(CommandKind::kKickOff, 0);
  link.say(CommandKind::kStart);
  EXPECT_EQ(link.command(), CommandKind::kKickOff);
  EXPECT_EQ(link.command(), CommandKind::kStart);
  link.box.act(BoxFault::kSplit);
  link.say(CommandKind::kStop);
  EXPECT_EQ(link.command(), CommandKind::kStop);
}

TEST(RefboxClient, WhatNobodyKnowsIsAWordForTheLogAndTheNextCommandIsHeard) {
  BoxLink link;
  link.meet();
  for (const BoxFault fault : {BoxFault::kUnknown, BoxFault::kBroken, BoxFault::kStatus, BoxFault::kOverlong}) {
    link.box.act(fault);
    link.say(CommandKind::kStop);
    const auto word = link.client->next(kBoxTimeout);
    ASSERT_TRUE(word && std::holds_alternative<NoCommand>(*word)) << static_cast<int>(fault);
    EXPECT_FALSE(std::get<NoCommand>(*word).why.empty());
    EXPECT_EQ(link.command(), CommandKind::kStop);
  }
}

TEST(RefboxClient, AClosedAndAResetConnectionAreLostAtOnceAndMadeAnew) {
  for (const BoxFault fault : {BoxFault::kClose, BoxFault::kReset}) {
    BoxLink link;
    link.meet();
    const auto before = Clock::now();
    link.box.act(fault);
    const auto lost = link.next<Lost>();
    ASSERT_TRUE(lost);
    EXPECT_LT(Clock::now() - before, std::chrono::milliseconds{500});
    EXPECT_THAT(lost->why, HasSubstr(fault == BoxFault::kClose ? "hung up" : "reset"));
    EXPECT_FALSE(link.client->connected());
    link.meet();
  }
}

TEST(RefboxClient, ABoxThatAcknowledgesNothingMoreIsLost) {
  // Longer than what a deaf box's kernel has room for: the first object is not acknowledged.
  std::string object = kWorldstate;
  object.insert(object.find("\"i\"") + 1, std::string(20'000, 'i'));
  BoxLink link;
  link.meet();
  link.client->send(object);
  ASSERT_TRUE(link.box.wait_for_objects(0, 1, kBoxTimeout));
  link.box.act(BoxFault::kDeaf);
  const auto deaf = Clock::now();
  std::optional<Lost> lost;
  const auto end = Clock::now() + kBoxTimeout;
  while (!lost && Clock::now() < end) {
    link.client->send(object);
    if (const auto event = link.client->next(std::chrono::milliseconds{20})) {
      ASSERT_TRUE(std::holds_alternative<Lost>(*event)) << event->index();
      lost = std::get<Lost>(*event);
    }
  }
  EXPECT_LT(Clock::now() - deaf, std::chrono::milliseconds{500});
  ASSERT_TRUE(lost);
  EXPECT_THAT(lost->why, testing::AnyOf(HasSubstr("has not acknowledged"), HasSubstr("takes no bytes")));
}

TEST(RefboxClient, TheBoxsOwnSilenceIsNoFault) {
  BoxLink link;
  link.meet();
  link.box.act(BoxFault::kSilent);
  const auto end = Clock::now() + 3 * tests::kAckTimeout;
  for (std::uint64_t sent = 1; Clock::now() < end; ++sent) {
    link.client->send(kWorldstate);
    EXPECT_FALSE(link.client->next(std::chrono::milliseconds{20}));
    ASSERT_TRUE(link.box.wait_for_objects(0, sent, kBoxTimeout));
  }
  EXPECT_TRUE(link.client->connected());
  link.box.act(BoxFault::kHeal);
  link.say(CommandKind::kStart);
  EXPECT_EQ(link.command(), CommandKind::kStart);
}

TEST(RefboxClient, ABoxThatIsNotThereIsSaidOnceAndConnectedToWhenItComes) {
  std::uint16_t port = 0;
  { port = EmulatedBox{BoxConfig{}}.port(); }
  const auto client = refbox_client("127.0.0.1", port, {}, tests::kAckTimeout);
  const auto said = client->next(kBoxTimeout);
  ASSERT_TRUE(said && std::holds_alternative<Unreachable>(*said));
  EXPECT_EQ(std::get<Unreachable>(*said).why, "connection refused");
  EXPECT_FALSE(client->next(3 * RefboxClient::kRetry)) << "it was said";
  const EmulatedBox box{{.port = port}};
  const auto met = client->next(kBoxTimeout);
  EXPECT_TRUE(met && std::holds_alternative<Connected>(*met));
}

TEST(RefboxClient, ASecondConnectionOfATeamIsTurnedAwayAndAsksAgainLater) {
  BoxLink link;
  link.meet();
  const auto other = refbox_client("127.0.0.1", link.box.port(), {}, tests::kAckTimeout);
  EXPECT_TRUE(std::holds_alternative<Connected>(other->next(kBoxTimeout).value()));
  ASSERT_TRUE(link.box.wait_for_teams(2, kBoxTimeout));
  const auto third = refbox_client("127.0.0.1", link.box.port(), {}, tests::kAckTimeout);
  EXPECT_TRUE(std::holds_alternative<Connected>(third->next(kBoxTimeout).value()));
  const auto reset = third->next(kBoxTimeout);
  ASSERT_TRUE(reset && std::holds_alternative<Command>(*reset));
  EXPECT_EQ(std::get<Command>(*reset).kind, CommandKind::kReset);
  EXPECT_TRUE(std::holds_alternative<Lost>(third->next(kBoxTimeout).value()));
  EXPECT_FALSE(third->next(RefboxClient::kRetryTurnedAway / 2)) << "each attempt may be heard by every team";
}

TEST(EmulatedBox, KnowsTeamsByTheirAddress) {
  using namespace std::string_literals;
  const EmulatedBox box{BoxConfig{}};
  const auto right = tests::connect_from("127.0.63.1", box.port());
  ASSERT_TRUE(box.wait_for_teams(1, kBoxTimeout));
  EXPECT_FALSE(box.report(0).connected);
  EXPECT_TRUE(box.report(1).connected);
  EXPECT_EQ(tests::read_all(right, 1), R"({"command":"WELCOME","emulated":true,"targetTeam":"224.16.32.63"})"s + '\0');
  const auto again = tests::connect_from("127.0.63.2", box.port());
  EXPECT_EQ(tests::read_all(again), R"({"command":"RESET","targetTeam":""})"s + '\0') << "and closed";
  EXPECT_TRUE(box.report(1).connected) << "the first one stays";
}

TEST(EmulatedBox, ReportsWhatATeamSends) {
  BoxLink link;
  link.meet();
  for (int i = 0; i < 5; ++i) link.client->send(kWorldstate);
  link.client->send(R"({"type":"worldstate"})");
  link.client->send(kWorldstate);
  ASSERT_TRUE(link.box.wait_for_objects(0, 6, kBoxTimeout));
  const TeamReport report = link.box.report(0);
  EXPECT_EQ(report.objects, 6U);
  EXPECT_EQ(report.problems, 1U);
  EXPECT_EQ(report.last, kWorldstate);
  EXPECT_THAT(report.last_problem, HasSubstr("teamName"));
}

TEST(EmulatedBox, APortThatIsTakenIsNamed) {
  const EmulatedBox box{BoxConfig{}};
  try {
    const EmulatedBox other{{.port = box.port()}};
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("port " + std::to_string(box.port())));
  }
}

TEST(Unacknowledged, IsTheAgeOfTheOldestByteThatWaits) {
  Unacknowledged watch;
  const Clock::time_point start{};
  const auto at = [&](int ms) { return start + std::chrono::milliseconds{ms}; };
  EXPECT_EQ(watch.age(0, at(5)), std::chrono::nanoseconds{0});
  watch.sent(100, at(0));
  watch.sent(100, at(100));
  EXPECT_EQ(watch.age(200, at(150)), std::chrono::milliseconds{150});
  EXPECT_EQ(watch.age(101, at(150)), std::chrono::milliseconds{150}) << "one byte of the first";
  EXPECT_EQ(watch.age(100, at(150)), std::chrono::milliseconds{50});
  EXPECT_EQ(watch.age(0, at(150)), std::chrono::nanoseconds{0});
  watch.sent(100, at(200));
  EXPECT_EQ(watch.age(100, at(210)), std::chrono::milliseconds{10});
}

}  // namespace
}  // namespace trivela::hal::refbox
