#include "hal/line/line_thread.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace trivela::hal {
namespace {

constexpr std::int64_t kWholeSecond_ns = 1'000'000'000;

std::int64_t line_now_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

int line_event() {
  const int event = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (event < 0) throw std::system_error{errno, std::generic_category(), "a line's thread cannot be woken"};
  return event;
}

}  // namespace

LineThread::LineThread(LineClient& client, const char* name)
    : client_(client), wake_(line_event()), thread_([this, name] { run(name); }) {}

LineThread::~LineThread() {
  {
    const std::lock_guard lock{mutex_};
    stopping_ = true;
  }
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
  thread_.join();
}

void LineThread::run(const char* name) {
  ::pthread_setname_np(::pthread_self(), name);
  std::unique_lock lock{mutex_};
  while (!stopping_) {
    client_.step(line_now_ns());
    changed_.notify_all();
    const std::int64_t until_ns = client_.next_ns();
    const int descriptor = client_.descriptor();
    lock.unlock();
    wait_for_events(until_ns, descriptor);
    lock.lock();
  }
}

void LineThread::wait_for_events(std::int64_t until_ns, int descriptor) const {
  const std::int64_t left_ns = std::max<std::int64_t>(until_ns - line_now_ns(), 0);
  const timespec time_out{static_cast<time_t>(left_ns / kWholeSecond_ns), left_ns % kWholeSecond_ns};
  std::array<pollfd, 2> polled{{{wake_.get(), POLLIN, 0}, {descriptor, POLLIN, 0}}};
  ::ppoll(polled.data(), polled.size(), &time_out, nullptr);
}

}  // namespace trivela::hal
