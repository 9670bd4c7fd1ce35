#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace trivela::hal {

/// A shot that was ordered.
struct Shot {
  std::int64_t kick_id = 0;
  double power = 0.0;
  std::int64_t t_ns = 0;     ///< when the coil is to be energised
  std::int64_t told_ns = 0;  ///< when it was ordered

  /// How far its instant lies behind, or the order where that came after it [ns].
  std::int64_t late_ns(std::int64_t now_ns) const { return now_ns - (t_ns > told_ns ? t_ns : told_ns); }
};

/// Shots that wait for their instants, all of the steady clock. One thread at a time.
class ShotQueue {
 public:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  void add(const Shot& shot);

  /// Drops the shot `kick_id` if its instant lies ahead of now_ns.
  void withdraw(std::int64_t kick_id, std::int64_t now_ns);

  /// Takes the earliest shot whose instant has come.
  std::optional<Shot> take_due(std::int64_t now_ns);

  /// The instant of the earliest; kNever_ns: there is none.
  std::int64_t next_ns() const { return shots_.empty() ? kNever_ns : shots_.front().t_ns; }

  void clear() noexcept { shots_.clear(); }

 private:
  std::vector<Shot> shots_;  // by instant, then as they were ordered
};

}  // namespace trivela::hal
