#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "idl/messages.hpp"

namespace trivela::robot {

/// Words to a coil (device/fire) for which no kicker's driver has answered: on a bus without keys any program can say
/// them. For any thread.
class FireWatch {
 public:
  /// So long a receipt may take: a driver that was killed after its word is answered for by the next one.
  static constexpr std::int64_t kTimeout_ns = 5'000'000'000;
  /// A note costs the recorder a transaction, and a flood of words is not to keep it from recording.
  static constexpr std::int64_t kPause_ns = 10'000'000'000;

  void fired(const msg::DeviceFire& fire, std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    if (fire.withdrawn || std::ranges::find(answered_, fire.kick_id) != answered_.end()) return;
    const bool known = std::ranges::any_of(waiting_, [&](const Waiting& one) { return is_same(one.fire, fire); });
    if (!known && waiting_.size() < kMost) waiting_.push_back({fire, now_ns});
  }

  /// A receipt that accepts an order answers for its kick.
  void answered(const msg::KickReceipt& receipt) {
    if (!receipt.accepted) return;
    const std::lock_guard lock{mutex_};
    if (answered_.size() == kMost) answered_.pop_front();
    answered_.push_back(receipt.kick_id);
    std::erase_if(waiting_, [&](const Waiting& one) { return one.fire.kick_id == receipt.kick_id; });
  }

  /// Those that nobody has answered for in time, each once; no more often than each kPause_ns.
  std::vector<msg::DeviceFire> unanswered(std::int64_t now_ns) {
    const std::lock_guard lock{mutex_};
    std::vector<msg::DeviceFire> over;
    if (said_ns_ && now_ns - *said_ns_ < kPause_ns) return over;
    std::erase_if(waiting_, [&](const Waiting& one) {
      if (now_ns - one.received_ns < kTimeout_ns) return false;
      over.push_back(one.fire);
      return true;
    });
    if (!over.empty()) said_ns_ = now_ns;
    return over;
  }

 private:
  static constexpr std::size_t kMost = 256;  // whoever floods the bus fills no memory
  struct Waiting {
    msg::DeviceFire fire;
    std::int64_t received_ns;
  };
  static bool is_same(const msg::DeviceFire& a, const msg::DeviceFire& b) {
    return a.robot_id == b.robot_id && a.kick_id == b.kick_id;
  }

  std::mutex mutex_;  // of what follows
  std::deque<std::int64_t> answered_;
  std::vector<Waiting> waiting_;
  std::optional<std::int64_t> said_ns_;  // unanswered() last gave any
};

}  // namespace trivela::robot
