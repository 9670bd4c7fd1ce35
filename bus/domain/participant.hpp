#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "bus/domain/domain.hpp"

namespace trivela::bus {

class ReaderHealth;

/// Real time: nobody waits for anybody, and every t_ns is the machine's steady clock.
struct RealTime {
  /// One line an event, on any thread.
  std::function<void(const std::string&)> warn = {};
  /// A member gives up (BusUnresponsive) no sooner than this after it joined.
  std::chrono::seconds stay{5};
};

/// A member of a DDS domain; copies are the same member. Readers and writers keep it alive. The participants of one
/// process with the same domain id share one configuration.
/// Set the scheduling first (bus/scheduling.hpp): Cyclone's threads inherit it from the first participant's creator.
class Participant {
 public:
  /// Joins the domain. Throws Error if Cyclone refuses the configuration, no port is free, this process is in the
  /// domain already with another configuration, or is short of file descriptors or threads.
  explicit Participant(const DomainConfig& config);

  /// The same for a run in real time: readers of topics with a period that hear nothing are made again.
  Participant(const DomainConfig& config, RealTime real_time);

  /// False where an instant cannot be true: in real time, below 0 or over a second ahead of the steady clock.
  bool believes(std::int64_t t_ns) const;

  /// When it joined.
  std::chrono::steady_clock::time_point joined() const;

  /// What the readers of this member miss; nullptr where this is no run in real time. For bus/ alone.
  ReaderHealth* hearing() const;

  /// Cyclone's handle, for bus/ alone.
  std::int32_t handle() const;

 private:
  struct State;
  Participant(const DomainConfig& config, std::unique_ptr<ReaderHealth> hearing);

  std::shared_ptr<const State> state_;
};

}  // namespace trivela::bus
