#include "bus/executor.hpp"

#include <pthread.h>

#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::bus {
namespace {

// How long a device may keep an executor from stopping.
constexpr std::chrono::milliseconds kDeviceTimeout{50};

void name_this_thread(const std::string& name) { pthread_setname_np(pthread_self(), name.substr(0, 15).c_str()); }

}  // namespace

Executor::Executor(Kind kind, Stop& stop, std::vector<Node*> nodes)
    : kind_(kind), stop_(stop), nodes_(std::move(nodes)) {}

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
    stop_.wait();
  });
  finish();
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

void Executor::finish() noexcept {
  guarded([this] {
    for (Node* node : nodes_) node->interrupt_->set();
  });
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  for (Node* node : nodes_)
    for (const auto& slot : node->slots_)
      if (slot->to_the_last && slot->reader && !failed()) take(*slot);
  // Deleting a reader waits for its listener to return.
  for (Node* node : nodes_)
    for (const auto& slot : node->slots_) slot->reader.reset();
}

void Executor::serve_topics(Node& node) {
  guarded([&] {
    name_this_thread(node.name());
    Waitset waitset(node.participant());
    waitset.attach(node.interrupt_->condition(), -1);
    for (std::size_t i = 0; i < node.slots_.size(); ++i)
      if (node.slots_[i]->reader) waitset.attach(node.slots_[i]->reader->condition(), static_cast<std::intptr_t>(i));
    while (!stop_.requested()) {
      for (const std::intptr_t i : waitset.wait(std::chrono::nanoseconds::max()))
        if (i >= 0) react(*node.slots_[static_cast<std::size_t>(i)]);
    }
  });
}

void Executor::serve_device(Slot& slot) {
  guarded([&] {
    name_this_thread(slot.reaction.name);
    const ReactionScope scope(slot.reaction, false);
    while (!stop_.requested()) slot.poll(kDeviceTimeout);
  });
}

void Executor::serve_timer(Slot& slot) {
  guarded([&] {
    name_this_thread(slot.reaction.name);
    const ReactionScope scope(slot.reaction, false);
    auto next = std::chrono::steady_clock::now() + slot.period;
    while (!stop_.wait_until(next)) {
      slot.tick();
      next = std::max(next + slot.period, std::chrono::steady_clock::now());
    }
  });
}

void Executor::react(Slot& slot) noexcept {
  if (!stop_.requested()) take(slot);
}

void Executor::take(Slot& slot) noexcept {
  guarded([&] {
    const std::lock_guard lock(slot.running);
    const ReactionScope scope(slot.reaction, kind_ == kListener);
    slot.take(*slot.reader);
  });
}

void Executor::on_data(void* context) noexcept {
  Slot& slot = *static_cast<Slot*>(context);
  if (slot.executor->listening_) slot.executor->react(slot);
}

}  // namespace trivela::bus
