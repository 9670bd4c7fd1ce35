// The second of two decision nodes in real time: the first one hangs or dies, and returns.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <csignal>
#include <optional>
#include <stdexcept>

#include "tests/e2e/log_rows.hpp"
#include "tests/faults/real_time_stack.hpp"

namespace trivela::faults {
namespace {

constexpr std::int64_t kMostWorlds = 25;  // half a second; measured are some six, but this machine is busy

std::int64_t count(const RealTimeStack& stack, const std::string& sql) {
  try {
    return e2e::number_of(e2e::Reader{stack.log()}, sql);
  } catch (const std::exception&) {
    return 0;  // the log is being made
  }
}

std::int64_t fired(const RealTimeStack& stack, std::uint32_t session) {
  return count(stack,
               fmt::format("SELECT count(*) FROM kick_receipts WHERE accepted = 1 AND kick_id >> 48 = {}", session));
}

bool says(const RealTimeStack& stack, const std::string& text) {
  return stack.errors_of("kick_decision_second").find(text) != std::string::npos;
}

/// Plays until the first has fired, is struck by `number`, and the second has fired.
void play_until_the_second_fires(const RealTimeStack& stack, int number) {
  EXPECT_TRUE(stack.wait_for([&] { return fired(stack, kFirstSession) > 0; }));
  stack.signal("kick_decision", number);
  const std::int64_t before = fired(stack, kFirstSession + 1);
  EXPECT_TRUE(stack.wait_for([&] { return fired(stack, kFirstSession + 1) > before + 1; }))
      << stack.errors_of("kick_decision_second");
}

void expect_drives_throughout(const RealTimeStack& stack) {
  const std::int64_t most = most_worlds_without_drive(stack.log());
  fmt::print("{} worlds in a row without a drive command at most\n", most);
  EXPECT_LE(most, kMostWorlds);
}

/// Of the possessions that were played: each that ended with a kick had one, each that a kick was ordered in and that
/// went on long enough for it ended with one.
void expect_each_possession_kicked_once(const RealTimeStack& stack) {
  EXPECT_EQ(count(stack, R"(
    SELECT count(*) FROM (SELECT count(DISTINCT kick_id) AS n FROM kicks WHERE accepted = 1 GROUP BY half, possession_id)
    WHERE n > 1)"),
            0);
  EXPECT_EQ(count(stack, R"(
    SELECT count(*) FROM possession_truths AS p WHERE 1 <> (SELECT count(*) FROM kick_truths AS k WHERE k.t_ns BETWEEN
    p.start_t_ns AND p.t_ns) AND p.ending = 'kicked')"),
            0)
      << "possessions that ended with a kick";
  // An order takes a cycle and its device's delay; after half a second without an answer nobody will answer it.
  EXPECT_EQ(count(stack, R"(
    SELECT count(*) FROM possession_truths AS p WHERE p.ending <> 'kicked' AND p.ending <> 'stopped' AND EXISTS (SELECT *
    FROM kick_orders AS o WHERE o.t_ns BETWEEN p.start_t_ns AND p.t_ns - 500000000))"),
            0)
      << "a kick that was ordered was lost";
  const std::int64_t kicked = count(stack, "SELECT count(*) FROM possession_truths WHERE ending = 'kicked'");
  EXPECT_EQ(count(stack, R"(SELECT count(*) FROM kick_receipts WHERE accepted = 1 AND t_ns <
    (SELECT max(t_ns) FROM possession_truths))"),
            kicked)
      << "but for the last one's, when the match ended with the ball on its way";
  fmt::print("{} possessions kicked, {} played\n", kicked, count(stack, "SELECT count(*) FROM possession_truths"));
  expect_drives_throughout(stack);
}

TEST(Standby, TakesOverFromOneThatHangsAndGivesBackWhenItReturns) {
  RealTimeStack stack{4.0, {.standby = true}};
  play_until_the_second_fires(stack, SIGSTOP);
  EXPECT_TRUE(says(stack, "this one decides"));
  expect_drives_throughout(stack);  // before the first one answers late what it was sent meanwhile
  const std::int64_t before = fired(stack, kFirstSession);
  stack.signal("kick_decision", SIGCONT);
  EXPECT_TRUE(stack.wait_for([&] { return says(stack, "is back and decides"); }));
  EXPECT_TRUE(stack.wait_for([&] { return fired(stack, kFirstSession) > before; })) << "the first one fires again";
  EXPECT_EQ(stack.casualties(), "");
  for (const auto& [node, code] : stack.stop()) EXPECT_EQ(code, 0) << node;
  expect_each_possession_kicked_once(stack);
}

TEST(Standby, TakesOverFromOneThatIsKilled) {
  RealTimeStack stack{4.0, {.standby = true}};
  play_until_the_second_fires(stack, SIGKILL);
  for (const auto& [node, code] : stack.stop()) EXPECT_EQ(code, node == "kick_decision" ? 128 + SIGKILL : 0) << node;
  expect_each_possession_kicked_once(stack);
}

}  // namespace
}  // namespace trivela::faults
