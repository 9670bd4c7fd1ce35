#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/chain/track.hpp"

namespace trivela::bench {

/// One way to get from a sensor sample to an order: a name and what each of its processes does until it is told to end
/// by SIGTERM. The children are made before the parent or they themselves know the bus.
class Contender {
 public:
  using Process = std::function<void(Track&)>;

  /// With a priority above 0 every child asks for SCHED_FIFO and locked memory first.
  Contender(std::string name, std::vector<Process> processes, int priority, std::string reference = {});
  Contender(const Contender&) = delete;
  Contender& operator=(const Contender&) = delete;
  /// Ends the children and waits for them.
  ~Contender();

  const std::string& name() const { return name_; }
  /// The contender beside which it is printed.
  const std::string& reference() const { return reference_; }
  Track& track() { return track_; }

  /// Runs batches until one arrives whole: every stage has found the next. Throws std::runtime_error after 20 s.
  void warm_up();

 private:
  std::string name_;
  std::string reference_;
  Track track_;
  std::vector<pid_t> children_;
};

/// Forks a child that dies with its parent and leaves by its exit code, without the parent's destructors.
pid_t fork_child(const std::function<void()>& body);

}  // namespace trivela::bench
