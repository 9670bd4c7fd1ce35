#include "bus/executor.hpp"

#include <poll.h>
#include <pthread.h>

#include <fmt/ranges.h>

#include <algorithm>

#include "bus/domain/reader_health.hpp"
#include "bus/renewal.hpp"

namespace trivela::bus {
namespace {

// How long a device may keep an executor from stopping.
constexpr std::chrono::milliseconds kDeviceTimeout{50};

// How often it is looked, in real time, whether a topic has fallen silent.
constexpr std::chrono::milliseconds kPollInterval{100};

using Clock = std::chrono::steady_clock;

void name_this_thread(const std::string& name) { pthread_setname_np(pthread_self(), name.substr(0, 15).c_str()); }

}  // namespace

Executor::Executor(Kind kind, Stop& stop, std::vector<Node*> nodes, WatchdogHook watchdog_hook)
    : kind_(kind), stop_(stop), nodes_(std::move(nodes)), watchdog_hook_(std::move(watchdog_hook)) {}

void Executor::run() {
  if (kind_ == kListener) {
    std::vector<Reaction> reactions;
    for (const Node* node : nodes_)
      for (Reaction& reaction : node->reactions()) reactions.push_back(std::move(reaction));
    if (const auto cycle = find_cycle(reactions))
      throw Error("run", "listeners", fmt::format("the reactions form a cycle: {}", fmt::join(*cycle, " -> ")));
  }
  guarded([this] {
    open_readers();
    if (kind_ == kListener) catch_up();
    start_threads();
    wait_for_stop();
    for (const Node* node : nodes_)
      if (node->on_stop_) node->on_stop_();
  });
  finish();
  StopOnSignals::lift_limit();
  if (failure_) std::rethrow_exception(failure_);
}

// Runs a part of the work; its first exception is kept and ends the run.
template <class F>
void Executor::guarded(F&& body) noexcept {
  try {
    body();
  } catch (...) {
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = std::current_exception();
    stop_.request();
  }
}

bool Executor::failed() {
  const std::lock_guard lock(failure_mutex_);
  return failure_ != nullptr;
}

void Executor::open_readers() {
  for (Node* node : nodes_) {
    for (const auto& slot : node->slots_) {
      if (!slot->open) continue;
      slot->executor = this;
      slot->reader = kind_ == kListener ? slot->open(&Executor::on_data, slot.get()) : slot->open(nullptr, nullptr);
    }
  }
}

// Listeners leave what arrives before every reader of the chain exists; it is taken here.
void Executor::catch_up() {
  listening_ = true;
  for (Node* node : nodes_)
    for (const auto& slot : node->slots_)
      if (slot->reader) react(*slot);
}

void Executor::start_threads() {
  for (Node* node : nodes_) {
    bool has_topics = false;
    for (const auto& slot : node->slots_) {
      has_topics = has_topics || slot->reader;
      if (slot->poll) threads_.emplace_back([this, &slot = *slot] { serve_device(slot); });
      if (slot->tick) threads_.emplace_back([this, &slot = *slot] { serve_timer(slot); });
    }
    if (has_topics && kind_ == kWaitset) threads_.emplace_back([this, node] { serve_topics(*node); });
  }
}

bool Executor::in_real_time() const {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [](const Node* node) { return node->participant().hearing() != nullptr; });
}

void Executor::wait_for_stop() {
  const bool real_time = in_real_time();
  if (!real_time && !watchdog_hook_.notify) return stop_.wait();
  pollfd stop{stop_.file_descriptor(), POLLIN, 0};
  for (notify(); !stop_.requested(); notify()) {
    poll(&stop, 1, static_cast<int>(kPollInterval.count()));
    if (real_time && !look_after_hearing()) return;
  }
}

// False: a participant is deaf, and this run is over.
bool Executor::look_after_hearing() {
  for (Node* node : nodes_) {
    const auto deaf = node->participant().hearing() ? node->participant().hearing()->deaf() : std::nullopt;
    if (deaf) {
      give_up(*deaf);
      return false;
    }
    for (const auto& mailbox : node->mailboxes_) mailbox();
    if (kind_ == kListener)
      for (const auto& slot : node->slots_) keep_hearing(*slot);
  }
  return true;
}

void Executor::notify() const {
  if (watchdog_hook_.notify && !stop_.requested()) watchdog_hook_.notify(late());
}

// The first loop or reaction that is; empty: all come round in time.
std::string Executor::late() const {
  const auto now = Clock::now();
  for (const Node* node : nodes_) {
    if (node->deadline_.late(now, watchdog_hook_.timeout)) return node->name();
    for (const auto& slot : node->slots_)
      if (slot->deadline.late(now, watchdog_hook_.timeout)) return slot->reaction.name;
  }
  return {};
}

// Ends this run, but not what the stop is for: who made the executor may make another.
void Executor::give_up(const BusUnresponsive& deaf) {
  const std::lock_guard lock(failure_mutex_);
  if (!failure_) failure_ = std::make_exception_ptr(deaf);
  over_ = true;
}

bool Executor::keep_hearing(Slot& slot) {
  if (!slot.reader || !renew_if_silent(*slot.reader, slot.running, [] {})) return false;
  react(slot);  // what came before it was in its place
  return true;
}

void Executor::finish() noexcept {
  guarded([this] {
    for (Node* node : nodes_) node->interrupt_->set();
  });
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  for (Node* node : nodes_)
    for (const auto& slot : node->slots_)
      if (slot->to_the_last && slot->reader && !failed()) take(*slot);
  for (Node* node : nodes_) {
    for (const auto& slot : node->slots_) {
      // To delete a reader waits for its listener, which may be waiting for this lock: it finds no reader then.
      std::unique_ptr<AnyReader> reader;
      const std::lock_guard lock(slot->running);
      reader = std::move(slot->reader);
    }
  }
}

void Executor::serve_topics(Node& node) {
  guarded([&] {
    name_this_thread(node.name());
    Waitset waitset(node.participant());
    waitset.attach(node.interrupt_->condition(), -1);
    const auto attach = [&](std::size_t i) {
      waitset.attach(node.slots_[i]->reader->condition(), static_cast<std::intptr_t>(i));
    };
    for (std::size_t i = 0; i < node.slots_.size(); ++i)
      if (node.slots_[i]->reader) attach(i);
    const bool real_time = node.participant().hearing() != nullptr;
    while (!over()) {
      if (real_time) node.deadline_.due(Clock::now() + kPollInterval);
      for (const std::intptr_t i : waitset.wait(real_time ? kPollInterval : std::chrono::nanoseconds::max()))
        if (i >= 0) react(*node.slots_[static_cast<std::size_t>(i)]);
      if (!real_time) continue;
      for (std::size_t i = 0; i < node.slots_.size(); ++i)
        if (keep_hearing(*node.slots_[i])) attach(i);
    }
  });
}

void Executor::serve_device(Slot& slot) {
  guarded([&] {
    name_this_thread(slot.reaction.name);
    const ReactionScope scope(slot.reaction, false);
    while (!over()) {
      slot.deadline.due(Clock::now() + kDeviceTimeout);
      slot.poll(kDeviceTimeout);
    }
    slot.deadline.idle();
  });
}

void Executor::serve_timer(Slot& slot) {
  guarded([&] {
    name_this_thread(slot.reaction.name);
    const ReactionScope scope(slot.reaction, false);
    auto next = Clock::now() + slot.first;
    for (slot.deadline.due(next); !stop_.wait_until(next) && !over(); slot.deadline.due(next)) {
      const auto pause = slot.tick();
      next = std::max(next + pause, Clock::now());
    }
    slot.deadline.idle();
  });
}

void Executor::react(Slot& slot) noexcept {
  if (!over()) take(slot);
}

void Executor::take(Slot& slot) noexcept {
  guarded([&] {
    const std::lock_guard lock(slot.running);
    const ReactionScope scope(slot.reaction, kind_ == kListener);
    if (!slot.reader) return;
    if (watchdog_hook_.notify) slot.deadline.due(Clock::now());
    slot.take(*slot.reader);
    slot.deadline.idle();
  });
}

void Executor::on_data(void* context) noexcept {
  Slot& slot = *static_cast<Slot*>(context);
  if (slot.executor->listening_) slot.executor->react(slot);
}

}  // namespace trivela::bus
