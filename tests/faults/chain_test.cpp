// The decision path in one process, in real time: it is killed, and comes back.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <csignal>
#include <stdexcept>

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

TEST(Chain, ADriverWhoseChainIsKilledSaysSoAndFiresAgainForTheNextOne) {
  RealTimeStack stack{4.0, {.one_process = true}};
  ASSERT_TRUE(stack.wait_for([&] { return fired(stack) > 1; }));
  stack.signal("chain", SIGKILL);
  EXPECT_TRUE(stack.wait_for([&] {
    return stack.errors_of("kicker_driver").find("the decision loop is silent") != std::string::npos;
  })) << stack.errors_of("kicker_driver");
  const std::int64_t before = fired(stack);
  stack.restart("chain");
  EXPECT_TRUE(stack.wait_for([&] { return fired(stack) > before + 1; })) << stack.errors_of("chain");
  EXPECT_EQ(stack.casualties(), "");
  for (const auto& [node, code] : stack.stop()) EXPECT_EQ(code, 0) << node;
}

}  // namespace
}  // namespace trivela::faults
