#include "bus/domain/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "bus/domain/cyclone.hpp"

namespace trivela::bus {
namespace {

std::string limit(int resource) {
  rlimit now{};
  getrlimit(resource, &now);
  return now.rlim_cur == RLIM_INFINITY ? "unlimited" : fmt::format("{}", now.rlim_cur);
}

/// How many can be opened, `enough` at most.
std::size_t free_descriptors(std::size_t enough) {
  std::vector<int> opened;
  opened.reserve(enough);
  while (opened.size() < enough) {
    const int descriptor = open("/", O_PATH | O_CLOEXEC);
    if (descriptor < 0) break;
    opened.push_back(descriptor);
  }
  for (const int descriptor : opened) close(descriptor);
  return opened.size();
}

/// How many can run at the same time, `enough` at most. They allocate nothing: a std::thread frees its state, for which
/// the C library reserves a heap of 64 MB of addresses to each thread, and never gives it back.
std::size_t free_threads(std::size_t enough) {
  std::mutex gate;
  std::unique_lock closed(gate);
  const auto pass = [](void* mutex) -> void* {
    const std::lock_guard lock(*static_cast<std::mutex*>(mutex));
    return nullptr;
  };
  std::vector<pthread_t> started;
  started.reserve(enough);
  for (pthread_t thread{}; started.size() < enough && pthread_create(&thread, nullptr, pass, &gate) == 0;)
    started.push_back(thread);
  closed.unlock();
  for (const pthread_t thread : started) pthread_join(thread, nullptr);
  return started.size();
}

/// The kernel keeps to the latency for as long as the file is open: until this process ends.
bool keep_processors_awake() {
  static const int file = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t longest_wake_up_us = 0;
  return file >= 0 && write(file, &longest_wake_up_us, sizeof longest_wake_up_us) == sizeof longest_wake_up_us;
}

}  // namespace

void require_resources() {
  // Who joins the bus again has just given back what the first participant took.
  static std::atomic<bool> there = false;
  if (there) return;
  if (const std::size_t free = free_descriptors(kDescriptors); free < kDescriptors) {
    throw Error("start", "file descriptors",
                fmt::format("{} free ones are needed, there are {}; ulimit -n is {}", kDescriptors, free,
                            limit(RLIMIT_NOFILE)));
  }
  if (const std::size_t free = free_threads(kThreads); free < kThreads) {
    throw Error("start", "threads",
                fmt::format("{} more are needed, {} can be started; ulimit -u is {}, ulimit -v {} bytes", kThreads,
                            free, limit(RLIMIT_NPROC), limit(RLIMIT_AS)));
  }
  there = true;
}

Realtime set_realtime(int priority) {
  const sched_param parameters{priority};
  return {.scheduled = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0,
          .memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0,
          .processors_awake = keep_processors_awake()};
}

std::vector<int> processors_allowed() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof allowed, &allowed);
  std::vector<int> processors;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor)
    if (CPU_ISSET(processor, &allowed)) processors.push_back(processor);
  return processors;
}

void stay_on(int processor) {
  const std::vector<int> allowed = processors_allowed();
  if (std::ranges::find(allowed, processor) == allowed.end()) {
    throw Error("start", fmt::format("processor {}", processor),
                fmt::format("this process may use {}", fmt::join(allowed, ", ")));
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0)
    throw Error("start", fmt::format("processor {}", processor), "the kernel does not keep this process there");
}

}  // namespace trivela::bus
