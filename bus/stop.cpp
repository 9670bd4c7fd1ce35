#include "bus/stop.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "bus/domain/cyclone.hpp"

namespace trivela::bus {
namespace {

std::atomic<Stop*> g_stop = nullptr;
std::atomic<unsigned> g_limit_s = 0;
constexpr std::array kSignals{SIGTERM, SIGINT, SIGHUP};
std::array<struct sigaction, kSignals.size()> g_before;
static_assert(std::atomic<Stop*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<unsigned>::is_always_lock_free);

void on_signal(int) {
  const int saved = errno;
  if (Stop* stop = g_stop.load()) {
    stop->request();
    alarm(g_limit_s.load());
  }
  errno = saved;
}

}  // namespace

Stop::Stop() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (event_ < 0) throw Error("eventfd", "stop", std::strerror(errno));
}

Stop::~Stop() { close(event_); }

void Stop::request() noexcept {
  requested_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  // Can fail only if it was requested before, and then it is readable already.
  [[maybe_unused]] const auto written = write(event_, &one, sizeof one);
}

void Stop::wait() const {
  pollfd event{event_, POLLIN, 0};
  while (!requested()) {
    if (poll(&event, 1, -1) < 0 && errno != EINTR) throw Error("poll", "stop", std::strerror(errno));
  }
}

bool Stop::wait_until(std::chrono::steady_clock::time_point end) const {
  pollfd event{event_, POLLIN, 0};
  while (!requested()) {
    const std::chrono::nanoseconds left = end - std::chrono::steady_clock::now();
    if (left <= left.zero()) return false;
    const timespec timeout{static_cast<time_t>(left.count() / 1'000'000'000),
                           static_cast<long>(left.count() % 1'000'000'000)};
    if (ppoll(&event, 1, &timeout, nullptr) < 0 && errno != EINTR) throw Error("poll", "stop", std::strerror(errno));
  }
  return true;
}

StopOnSignals::StopOnSignals(Stop& stop, std::chrono::seconds limit) {
  g_limit_s.store(static_cast<unsigned>(limit.count()));
  [[maybe_unused]] Stop* before = g_stop.exchange(&stop);
  assert(before == nullptr);
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &action, &g_before[i]);
    const bool of_nohup = kSignals[i] == SIGHUP && g_before[i].sa_handler == SIG_IGN;
    if (of_nohup) sigaction(kSignals[i], &g_before[i], nullptr);
  }
}

void StopOnSignals::lift_limit() noexcept { alarm(0); }

StopOnSignals::~StopOnSignals() {
  lift_limit();
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &g_before[i], nullptr);
  g_stop.store(nullptr);
}

}  // namespace trivela::bus
