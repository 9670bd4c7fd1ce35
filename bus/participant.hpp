#pragma once

#include <memory>

#include "bus/domain.hpp"

namespace trivela::bus {

/// A member of a DDS domain; copies are the same member. Readers and writers keep it alive. The participants of one
/// process with the same domain id share one configuration.
/// Set the scheduling first (bus/scheduling.hpp): Cyclone's threads inherit it from the first participant's creator.
class Participant {
 public:
  /// Joins the domain. Throws Error if Cyclone refuses the configuration, no port is free, this process is in the
  /// domain already with another configuration, or is short of file descriptors or threads.
  explicit Participant(const DomainConfig& config);

  /// Cyclone's handle, for bus/ alone.
  std::int32_t handle() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace trivela::bus
