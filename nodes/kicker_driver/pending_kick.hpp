#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <type_traits>

#include "config/settings.hpp"
#include "idl/messages.hpp"

namespace trivela::nodes {

/// The last accepted kick, in memory that outlives the process: a driver that was killed before it told the device, or
/// while it did, leaves the kick's receipt to its successor, which sends another one. Written by the driver's thread
/// and by the one that writes to the device; the state is one word, so that a kill leaves a whole record.
class PendingKick {
 public:
  struct Left {
    msg::KickReceipt receipt;  ///< as it was sent, or was about to be
    bool being_told = false;   ///< the device may have been told
  };

  /// Of the memory: the same for a driver and its successor, another for each bus and robot.
  static std::string name_of(const config::Domain& domain, std::uint8_t robot_id);

  /// `name`: as name_of() gives it. Where the system gives no memory (why()) nothing is kept.
  explicit PendingKick(const std::string& name);
  /// Leaves the memory behind only where a kick is open.
  ~PendingKick();
  PendingKick(const PendingKick&) = delete;
  PendingKick& operator=(const PendingKick&) = delete;

  /// What the predecessor accepted and did not settle. Until forget() or the next accepted().
  const std::optional<Left>& left() const { return left_; }

  void forget() { left_.reset(); }

  void accepted(const msg::KickReceipt& receipt);
  /// From here on the device may be told.
  void being_told() noexcept;
  /// The device was told, or a receipt says that it was not.
  void settled() noexcept;

  /// Why nothing is kept; empty: it is.
  const std::string& why() const { return why_; }

 private:
  enum class State : int { kNone, kAccepted, kBeingTold };
  struct Record {
    std::atomic<State> state;
    msg::KickReceipt receipt;
  };
  static_assert(std::atomic<State>::is_always_lock_free && std::is_trivially_copyable_v<msg::KickReceipt>);

  std::string name_;
  Record* record_ = nullptr;
  std::optional<Left> left_;
  std::string why_;
};

}  // namespace trivela::nodes
