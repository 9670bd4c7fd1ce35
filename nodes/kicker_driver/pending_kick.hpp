#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "config/settings.hpp"

namespace trivela::nodes {

/// The last accepted kick, in memory that outlives the process: a driver that was killed before it told the device
/// leaves it to its successor, which says that the kick was not fired. Written by the driver's thread and, in
/// settled(), by the one that writes to the device; each store is one word, so that a kill leaves a whole record.
class PendingKick {
 public:
  struct Left {
    std::int64_t kick_id;
    std::int64_t order_t_ns;
  };

  /// Of the memory: the same for a driver and its successor, another for each bus and robot.
  static std::string name_of(const config::Domain& domain, std::uint8_t robot_id);

  /// `name`: as name_of() gives it. Where the system gives no memory (why()) nothing is kept.
  explicit PendingKick(const std::string& name);
  /// Leaves the memory behind only where a kick is open.
  ~PendingKick();
  PendingKick(const PendingKick&) = delete;
  PendingKick& operator=(const PendingKick&) = delete;

  /// What the predecessor accepted and never told the device. Until forget() or the next accepted().
  std::optional<Left> left() const { return left_; }

  void forget() { left_.reset(); }

  void accepted(std::int64_t kick_id, std::int64_t order_t_ns);
  /// From here on the device may have been told, or a receipt says that it was not.
  void settled() noexcept;

  /// Why nothing is kept; empty: it is.
  const std::string& why() const { return why_; }

 private:
  struct Record {
    std::atomic<std::int64_t> open_kick_id;  // 0: none
    std::int64_t order_t_ns;
  };
  static_assert(std::atomic<std::int64_t>::is_always_lock_free);

  std::string name_;
  Record* record_ = nullptr;
  std::optional<Left> left_;
  std::string why_;
};

}  // namespace trivela::nodes
