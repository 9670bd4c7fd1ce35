#include "bus/domain/process.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>

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

namespace {

constexpr unsigned kFirstPort = 7400, kLastPort = 7400 + 250 * 101 - 1;  // RTPS 9.6.2.1

bool receives_all(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in own{};
  size = sizeof own;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0 || own.sin_family != AF_INET) return false;
  const unsigned port = ntohs(own.sin_port);
  if (own.sin_addr.s_addr != htonl(INADDR_ANY) || port < kFirstPort || port > kLastPort) return false;
  std::array<char, 16> device{};
  size = device.size();
  return getsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size) != 0 || size == 0;
}

}  // namespace

bool loopback_alone(std::string_view xml) {
  constexpr std::string_view kElement = "<NetworkInterface ";
  const auto first = xml.find(kElement);
  return first != std::string_view::npos && xml.find(kElement, first + 1) == std::string_view::npos &&
         xml.substr(first).starts_with(R"(<NetworkInterface name="lo")");
}

std::set<int> open_to_all() {
  std::set<int> found;
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator{"/proc/self/fd", gone}) {
    const std::string name = entry.path().filename().string();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (descriptor >= 0 && receives_all(descriptor)) found.insert(descriptor);
  }
  return found;
}

void receive_loopback_only(int socket) {
  constexpr std::string_view kLoopback = "lo";
  if (setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kLoopback.data(), kLoopback.size()) != 0)
    throw Error("SO_BINDTODEVICE", "lo", std::strerror(errno));
}

}  // namespace trivela::bus
