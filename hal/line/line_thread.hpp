#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "hal/line/descriptor.hpp"

namespace trivela::hal {

/// Our end of a line, for a LineThread. It looks at no clock and never waits: now_ns is the steady clock's.
class LineClient {
 public:
  virtual ~LineClient() = default;

  /// Opens the line where it is closed, takes what has come and sends what is due.
  virtual void step(std::int64_t now_ns) = 0;

  /// When step() is to be called though nothing comes.
  virtual std::int64_t next_ns() const = 0;

  /// Readable when something has come; -1: the line is closed.
  virtual int descriptor() const = 0;
};

/// Steps a client whenever something comes or is due, in a thread with the priority of whoever makes it.
class LineThread {
 public:
  /// Starts it; `client` outlives it, `name` has at most 15 letters. Throws std::system_error where the system has
  /// none.
  LineThread(LineClient& client, const char* name);
  /// Waits for its end.
  ~LineThread();
  LineThread(const LineThread&) = delete;
  LineThread& operator=(const LineThread&) = delete;

  /// What `look` gives, which is called while the thread does not touch the client.
  template <class Look>
  auto with_client(Look&& look) const {
    const std::lock_guard lock{mutex_};
    return look();
  }

  /// Waits until `done`, which is asked now and after each step. False: not within `timeout`.
  template <class Done>
  bool wait(std::chrono::nanoseconds timeout, Done&& done) {
    std::unique_lock lock{mutex_};
    return changed_.wait_for(lock, timeout, done);
  }

 private:
  void run(const char* name);
  void wait_for_events(std::int64_t until_ns, int descriptor) const;

  LineClient& client_;
  const Descriptor wake_;
  mutable std::mutex mutex_;  // of the client
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace trivela::hal
