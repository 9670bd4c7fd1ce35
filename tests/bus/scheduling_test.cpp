#include "bus/scheduling.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>

#include "bus/participant.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

constexpr int kPriority = 10;

// Whether this process has several threads and all run as SCHED_FIFO at the priority.
bool all_threads_are_realtime() {
  int realtime = 0, all = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const pid_t thread = std::stoi(task.path().filename());
    sched_param parameters{};
    sched_getparam(thread, &parameters);
    realtime += sched_getscheduler(thread) == SCHED_FIFO && parameters.sched_priority == kPriority;
    ++all;
  }
  return all > 1 && realtime == all;
}

// In children, so that this process stays as it is.
TEST(SchedulingDeathTest, SaysTruthfullyWhetherItWasPermitted) {
  EXPECT_EXIT(
      {
        const Realtime realtime = set_realtime(kPriority);
        _exit(realtime.scheduled == (sched_getscheduler(0) == SCHED_FIFO) ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(SchedulingDeathTest, TheBussThreadsInheritIt) {
  EXPECT_EXIT(
      {
        if (!set_realtime(kPriority).scheduled) _exit(0);  // nothing to inherit here
        const Participant participant(fresh_domain());
        _exit(all_threads_are_realtime() ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(SchedulingDeathTest, AnImpossiblePriorityIsNotPermitted) {
  EXPECT_EXIT(_exit(set_realtime(1000).scheduled ? 1 : 0), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace trivela::bus
