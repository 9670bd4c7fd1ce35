#include "tests/faults/hub.hpp"

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>
#include <queue>
#include <random>
#include <thread>

#include "tests/faults/frame.hpp"

namespace trivela::faults {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLongestFrame = 2048;
constexpr std::size_t kMostBits = 8;  // turned over in a datagram
constexpr std::size_t kMostConfined = 4;
constexpr std::size_t kMostOverheard = 2000;

struct Waiting {
  Clock::time_point due;
  std::size_t to;
  std::vector<std::uint8_t> frame;
  bool operator>(const Waiting& other) const { return due > other.due; }
};

timespec time_until(Clock::time_point due) {
  const auto left = std::max(due - Clock::now(), Clock::duration::zero());
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {seconds.count(), std::chrono::nanoseconds{left - seconds}.count()};
}

}  // namespace

struct Hub::Impl {
  Impl(std::vector<Cable> all, std::uint64_t seed) : cables(std::move(all)), random(seed) {}

  std::vector<Cable> cables;
  int stop = eventfd(0, EFD_CLOEXEC);
  mutable std::mutex mutex;
  Ways ways;                                          // under the mutex
  HubCounts counts;                                   // under the mutex
  std::deque<std::vector<std::uint8_t>> overheard;    // under the mutex
  AirMeter meter;                                     // under the mutex
  std::deque<std::pair<Guid, std::size_t>> confined;  // under the mutex
  std::optional<std::size_t> keeps_garbled;           // under the mutex
  std::vector<GarbledFrame> garbled;                  // under the mutex
  std::mt19937_64 random;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  std::thread thread;

  void run() {
    // A frame that waits for a busy machine would be a fault that nobody ordered.
    const sched_param priority{.sched_priority = 10};
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
    std::vector<pollfd> sources{{stop, POLLIN, 0}};
    for (const Cable& cable : cables) sources.push_back({cable.descriptor, POLLIN, 0});
    for (;;) {
      const timespec left = waiting.empty() ? timespec{1, 0} : time_until(waiting.top().due);
      ppoll(sources.data(), sources.size(), &left, nullptr);
      if (sources[0].revents != 0) return;
      deliver_what_is_due();
      for (std::size_t from = 0; from < cables.size(); ++from) {
        if (sources[from + 1].revents != 0) take_from(from);
      }
    }
  }

  void note(Frame payload) {
    if (payload.empty()) return;
    overheard.emplace_back(payload.begin(), payload.end());
    if (overheard.size() > kMostOverheard) overheard.pop_front();
  }

  void deliver_what_is_due() {
    const auto now = Clock::now();
    while (!waiting.empty() && waiting.top().due <= now) {
      const Waiting& next = waiting.top();
      put(next.to, next.frame);
      waiting.pop();
    }
  }

  void take_from(std::size_t from) {
    std::array<std::uint8_t, kLongestFrame> buffer;
    for (;;) {
      const ssize_t size = read(cables[from].descriptor, buffer.data(), buffer.size());
      if (size <= 0) return;
      const Frame frame{buffer.data(), static_cast<std::size_t>(size)};
      {
        const std::lock_guard lock{mutex};
        meter.count(frame);
        note(udp_payload(frame));
      }
      const auto receiver = receiver_of(frame);
      for (std::size_t to = 0; to < cables.size(); ++to) {
        if (to != from && (!receiver || *receiver == cables[to].number)) send(from, to, frame);
      }
    }
  }

  void send(std::size_t from, std::size_t to, Frame frame) {
    const std::lock_guard lock{mutex};
    ++counts.forwarded;
    std::vector<std::uint8_t> copy{frame.begin(), frame.end()};
    for (const auto& [writer, listener] : confined) {
      if (to != listener) mute(copy, writer);
    }
    const auto found = ways.find({from, to});
    if (found == ways.end()) return put(to, copy);
    const Way& way = found->second;
    std::uniform_real_distribution<double> share{0.0, 1.0};
    if (share(random) < way.drop) {
      ++counts.dropped;
      return;
    }
    const bool hit = share(random) < way.garble && garble(copy, kMostBits, random);
    const auto delay = way.delay + std::chrono::microseconds{std::llround(share(random) * double(way.jitter.count()))};
    if (hit) {
      ++counts.garbled;
      if (keeps_garbled == to) garbled.push_back({(Clock::now() + delay).time_since_epoch().count(), copy});
    }
    if (delay == delay.zero()) return put(to, copy);
    ++counts.delayed;
    waiting.push({Clock::now() + delay, to, std::move(copy)});
  }

  /// A host that takes nothing in loses the frame, as on any cable.
  void put(std::size_t to, std::span<const std::uint8_t> frame) const {
    [[maybe_unused]] const ssize_t written = write(cables[to].descriptor, frame.data(), frame.size());
  }
};

Hub::Hub(std::vector<Cable> cables, std::uint64_t seed) : impl_(std::make_unique<Impl>(std::move(cables), seed)) {
  impl_->thread = std::thread{[impl = impl_.get()] { impl->run(); }};
}

Hub::~Hub() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(impl_->stop, &one, sizeof one);
  impl_->thread.join();
  close(impl_->stop);
}

void Hub::set(Ways ways) {
  const std::lock_guard lock{impl_->mutex};
  impl_->ways = std::move(ways);
}

void Hub::confine(const Guid& writer, std::size_t listener) {
  const std::lock_guard lock{impl_->mutex};
  impl_->confined.emplace_back(writer, listener);
  if (impl_->confined.size() > kMostConfined) impl_->confined.pop_front();  // a writer that has long gone
}

void Hub::keep_garbled(std::size_t to) {
  const std::lock_guard lock{impl_->mutex};
  impl_->keeps_garbled = to;
}

std::vector<GarbledFrame> Hub::garbled() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->garbled;
}

std::vector<std::vector<std::uint8_t>> Hub::overheard() const {
  const std::lock_guard lock{impl_->mutex};
  return {impl_->overheard.begin(), impl_->overheard.end()};
}

AirMeter Hub::meter() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->meter;
}

HubCounts Hub::counts() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->counts;
}

}  // namespace trivela::faults
