#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/participant.hpp"

namespace trivela::bus {

/// Blocks a thread until one of several Cyclone conditions holds; for bus/ alone.
class Waitset {
 public:
  explicit Waitset(const Participant& participant);

  /// The id is what wait() reports for it.
  void attach(std::int32_t condition, std::intptr_t id);

  /// The ids of the conditions that hold, waiting up to the timeout for the first (nanoseconds::max(): for ever).
  const std::vector<std::intptr_t>& wait(std::chrono::nanoseconds timeout);

 private:
  Participant participant_;
  Entity entity_;
  std::vector<std::intptr_t> buffer_;
  std::vector<std::intptr_t> triggered_;
};

/// A condition that a program sets, e.g. to end a wait; for bus/ alone.
class Guard {
 public:
  explicit Guard(const Participant& participant);
  void set();
  bool is_set() const;
  std::int32_t condition() const { return entity_.handle(); }

 private:
  Participant participant_;
  Entity entity_;
};

}  // namespace trivela::bus
