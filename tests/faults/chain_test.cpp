// The decision path in one process, in real time: it is killed or stands still, and comes back.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "tests/e2e/log_rows.hpp"
#include "tests/faults/real_time_stack.hpp"

namespace trivela::faults {
namespace {

std::int64_t fired(const RealTimeStack& stack) {
  try {
    return e2e::number_of(e2e::Reader{stack.log()}, "SELECT count(*) FROM kick_receipts WHERE accepted = 1");
  } catch (const std::exception&) {
    return 0;  // the log is being made
  }
}

class Chain : public testing::Test {
 protected:
  /// Signals the chain; whether the driver then says that nobody decides.
  bool is_missed_after(int signal) {
    const std::size_t said = stack.errors_of("kicker_driver").size();
    stack.signal("chain", signal);
    return stack.wait_for([&] {
      return stack.errors_of("kicker_driver").find("the decision loop is silent", said) != std::string::npos;
    });
  }

  /// Two kicks more than there were, and all nodes go when they are asked to.
  void expect_that_it_plays_on() {
    const std::int64_t before = fired(stack);
    EXPECT_TRUE(stack.wait_for([&] { return fired(stack) > before + 1; })) << stack.errors_of("chain");
    EXPECT_EQ(stack.casualties(), "");
    for (const auto& [node, code] : stack.stop()) EXPECT_EQ(code, 0) << node;
  }

  RealTimeStack stack{4.0, {.one_process = true}};
};

TEST_F(Chain, ADriverWhoseChainIsKilledSaysSoAndFiresAgainForTheNextOne) {
  ASSERT_TRUE(stack.wait_for([&] { return fired(stack) > 1; }));
  EXPECT_TRUE(is_missed_after(SIGKILL)) << stack.errors_of("kicker_driver");
  stack.restart("chain");
  expect_that_it_plays_on();
}

TEST_F(Chain, ADriverWhoseChainStandsStillSaysSoAndFiresAgainWhenItGoesOn) {
  ASSERT_TRUE(stack.wait_for([&] { return fired(stack) > 1; }));
  EXPECT_TRUE(is_missed_after(SIGSTOP)) << stack.errors_of("kicker_driver");
  stack.signal("chain", SIGCONT);
  expect_that_it_plays_on();
}

}  // namespace
}  // namespace trivela::faults
