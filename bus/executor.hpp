#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "bus/node.hpp"
#include "bus/stop.hpp"
#include "bus/watchdog_hook.hpp"

namespace trivela::bus {

/// Runs the reactions of one or more nodes. Devices and timers always have a thread each; topics come in one of two
/// ways:
///
/// kWaitset: each node has one thread that waits for its topics and runs its reactions one after the other. They may
/// wait, e.g. in Mailbox::await.
///
/// kListener: a reaction runs in the thread that brings the sample: Cyclone's receive thread, or the writing thread of
/// this process, so that a chain of nodes in one process runs to completion in its sensor's thread. Lowest latency,
/// also for a node in a process of its own. Reactions must neither wait nor take long (nothing else is received
/// meanwhile), and over the nodes of this executor they must not form a cycle.
class Executor {
 public:
  enum Kind { kWaitset, kListener };

  /// The nodes and the stop outlive the executor; a node runs once.
  Executor(Kind kind, Stop& stop, std::vector<Node*> nodes, WatchdogHook watchdog_hook = {});
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// Runs until the stop is requested; what has then arrived for a reaction with ReaderOptions::keep_all is still
  /// delivered. Throws Error naming the topics if the reactions form a cycle (kListener), and
  /// rethrows the first exception of a reaction, which ends the run; BusUnresponsive, where a participant in real time
  /// does not hear what its nodes need and making readers again does not help.
  void run();

 private:
  using Slot = Node::Slot;

  void open_readers();
  void catch_up();
  void start_threads();
  void wait_for_stop();
  bool look_after_hearing();
  void notify() const;
  std::string late() const;
  bool in_real_time() const;
  void give_up(const class BusUnresponsive& deaf);
  bool over() const { return over_ || stop_.requested(); }
  void finish() noexcept;
  void serve_topics(Node& node);
  void serve_device(Slot& slot);
  void serve_timer(Slot& slot);
  void react(Slot& slot) noexcept;
  void take(Slot& slot) noexcept;
  bool keep_hearing(Slot& slot);
  bool failed();
  static void on_data(void* slot) noexcept;
  template <class F>
  void guarded(F&& body) noexcept;

  Kind kind_;
  Stop& stop_;
  std::vector<Node*> nodes_;
  WatchdogHook watchdog_hook_;
  std::atomic<bool> listening_ = false;
  std::atomic<bool> over_ = false;
  std::vector<std::thread> threads_;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace trivela::bus
