#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "bus/domain/cyclone.hpp"
#include "bus/reactions.hpp"
#include "bus/reader.hpp"
#include "bus/renewal.hpp"
#include "bus/waitset.hpp"

namespace trivela::bus {

/// When something came last, for any thread, without a lock.
class LastReceived {
 public:
  void now() noexcept {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    ns_.store(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count(), std::memory_order_relaxed);
  }

  /// Nanoseconds of the steady clock; 0: never.
  std::int64_t ns() const noexcept { return ns_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::int64_t> ns_ = 0;
};

/// Something that a node takes or stores.
struct Input {
  std::string name;       ///< topic, or "device:NAME"
  double period_s = 0.0;  ///< longest time between two samples while all is well; 0: none is known

  /// When it came last, as LastReceived::ns() has it. Where that was before `before_ns`, looks for what has arrived
  /// since and was not taken yet.
  std::function<std::int64_t(std::int64_t before_ns)> received_ns;
};

/// The latest sample of a topic, for whoever looks: nothing is called when one arrives. May be used from several
/// threads; a waiting one keeps the others out.
template <Message T>
class Mailbox {
 public:
  using OnEach = std::function<void(const T& sample, const SampleInfo& info)>;

  /// With a robot_id only that robot's samples count. The interrupt, if given, ends waits once it is set. `on_each` is
  /// called with each sample that is taken, one at a time, by whichever thread takes it.
  explicit Mailbox(const Participant& participant, std::optional<std::uint8_t> robot_id = {},
                   const ReaderOptions& options = {}, std::shared_ptr<const Guard> interrupt = nullptr,
                   OnEach on_each = {})
      : reader_(participant, options),
        robot_id_(robot_id),
        interrupt_(std::move(interrupt)),
        waitset_(participant),
        on_each_(std::move(on_each)) {
    waitset_.attach(reader_.condition(), 0);
    if (interrupt_) waitset_.attach(interrupt_->condition(), 1);
  }

  /// The sample that arrived last, if any did.
  std::optional<T> latest() {
    const std::lock_guard lock(mutex_);
    take();
    return latest_;
  }

  /// The first sample seen with t_ns at or after the given, waiting up to the timeout for it; none if the timeout or
  /// the interrupt came first. In a listener, which must not wait, throws Error if it has not arrived yet.
  std::optional<T> await(std::int64_t t_ns, std::chrono::nanoseconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    const std::lock_guard lock(mutex_);
    for (;;) {
      take();
      if (latest_ && latest_->t_ns >= t_ns) return latest_;
      if (interrupt_ && interrupt_->is_set()) return std::nullopt;
      if (ReactionScope::in_listener())
        throw Error("await", reader_.topic(), "would block the thread that delivers samples: use Executor::kWaitset");
      const auto left = deadline - std::chrono::steady_clock::now();
      if (left <= left.zero()) return std::nullopt;
      waitset_.wait(left);
    }
  }

  /// When a sample was taken last (LastReceived::ns()). Where that was before `before_ns`, takes what has arrived,
  /// unless another thread is at it.
  std::int64_t received_ns(std::int64_t before_ns) {
    if (received_.ns() >= before_ns) return received_.ns();
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock) take();
    return received_.ns();
  }

  AnyReader& reader() { return reader_; }

  /// In real time, to be called now and then, but by no listener: makes a reader again that has heard nothing for too
  /// long. A node's executor does it.
  void keep_hearing() {
    renew_if_silent(reader_, mutex_, [this] { waitset_.attach(reader_.condition(), 0); });
  }

 private:
  void take() {
    reader_.take([this](const T& sample, const SampleInfo& info) {
      if (robot_id_ && sample.robot_id != *robot_id_) return;
      if (on_each_) on_each_(sample, info);
      latest_ = sample;
      received_.now();
    });
  }

  std::mutex mutex_;
  Reader<T> reader_;
  std::optional<std::uint8_t> robot_id_;
  std::shared_ptr<const Guard> interrupt_;
  Waitset waitset_;
  OnEach on_each_;
  std::optional<T> latest_;
  LastReceived received_;
};

}  // namespace trivela::bus
