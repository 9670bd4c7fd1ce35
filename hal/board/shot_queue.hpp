#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "hal/kicker.hpp"

namespace trivela::hal {

/// Shots that wait for their instants, all of the steady clock. One thread at a time.
class ShotQueue {
 public:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  void add(const Shot& shot);

  /// Drops the shot `kick_id`, also where its instant has come and nobody has taken it.
  void withdraw(std::int64_t kick_id);

  /// Takes the earliest shot whose instant has come.
  std::optional<Shot> take_due(std::int64_t now_ns);

  /// The instant of the earliest; kNever_ns: there is none.
  std::int64_t next_ns() const { return shots_.empty() ? kNever_ns : shots_.front().t_ns; }

  void clear() noexcept { shots_.clear(); }

 private:
  std::vector<Shot> shots_;  // by instant, then as they were ordered
};

}  // namespace trivela::hal
