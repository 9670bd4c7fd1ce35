#include "bus/domain/process.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/participant.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

constexpr int kPriority = 10;

std::set<pid_t> threads() {
  std::set<pid_t> threads;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
    threads.insert(std::stoi(task.path().filename()));
  return threads;
}

bool is_realtime(pid_t thread) {
  sched_param parameters{};
  return sched_getparam(thread, &parameters) == 0 && parameters.sched_priority == kPriority &&
         sched_getscheduler(thread) == SCHED_FIFO;
}

// What the kernel keeps to at present; -1: it does not say.
std::int32_t longest_wake_up_us() {
  std::int32_t latency_us = -1;
  std::ifstream in{"/dev/cpu_dma_latency", std::ios::binary};
  in.read(reinterpret_cast<char*>(&latency_us), sizeof latency_us);
  return latency_us;
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
        const auto before = threads();
        const Participant participant(fresh_domain());
        auto started = threads();
        for (const pid_t thread : before) started.erase(thread);
        _exit(!started.empty() && std::all_of(started.begin(), started.end(), is_realtime) ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(SchedulingDeathTest, TheProcessorsStayAwakeWhereThatWasPermitted) {
  EXPECT_EXIT(_exit(!set_realtime(kPriority).processors_awake || longest_wake_up_us() == 0 ? 0 : 1),
              ::testing::ExitedWithCode(0), "");
}

TEST(SchedulingDeathTest, AnImpossiblePriorityIsNotPermitted) {
  EXPECT_EXIT(_exit(set_realtime(1000).scheduled ? 1 : 0), ::testing::ExitedWithCode(0), "");
}

TEST(SchedulingDeathTest, ThisThreadAndTheBussStayOnTheProcessorThatIsNamed) {
  EXPECT_EXIT(
      {
        const int processor = processors_allowed().back();
        stay_on(processor);
        const Participant participant(fresh_domain());
        bool all_there = processors_allowed() == std::vector{processor};
        for (const pid_t thread : threads()) {
          cpu_set_t allowed;
          all_there = all_there && sched_getaffinity(thread, sizeof allowed, &allowed) == 0 &&
                      CPU_COUNT(&allowed) == 1 && CPU_ISSET(processor, &allowed);
        }
        _exit(all_there && threads().size() > 1 ? 0 : 1);
      },
      ::testing::ExitedWithCode(0), "");
}

TEST(Scheduling, AProcessorThatIsNotThereIsRefusedByNamingThoseThatAre) {
  const std::vector<int> before = processors_allowed();
  ASSERT_FALSE(before.empty());
  for (const int processor : {-1, before.back() + 1, 1'000'000}) {
    try {
      stay_on(processor);
      FAIL() << processor;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(fmt::format("processor {}", processor)));
      EXPECT_THAT(error.what(), ::testing::HasSubstr(fmt::format("may use {}", fmt::join(before, ", "))));
    }
  }
  EXPECT_EQ(processors_allowed(), before);
}

}  // namespace
}  // namespace trivela::bus
