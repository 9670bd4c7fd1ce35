#include "bus/resources.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "bus/error.hpp"

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

/// How many can run at the same time, `enough` at most.
std::size_t free_threads(std::size_t enough) {
  std::mutex mutex;
  std::condition_variable all_started;
  bool over = false;
  std::vector<std::jthread> started;
  started.reserve(enough);
  try {
    while (started.size() < enough) {
      started.emplace_back([&] {
        std::unique_lock lock(mutex);
        all_started.wait(lock, [&] { return over; });
      });
    }
  } catch (const std::system_error&) {  // the limit
  }
  const std::size_t count = started.size();
  {
    const std::lock_guard lock(mutex);
    over = true;
  }
  all_started.notify_all();
  return count;
}

}  // namespace

void require_resources() {
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
}

}  // namespace trivela::bus
