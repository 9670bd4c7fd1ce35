#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

namespace trivela::nodes {

/// Which kick a pulse of a coil was: a board knows no numbers of kicks, the driver's receipts do. Instants of one
/// clock.
class RecentReceipts {
 public:
  /// A pulse and its receipt are at most so far apart: a board's shot that waited for longer is not sent, and a driver
  /// lets no two kicks come so close.
  static constexpr std::int64_t kFarthest_ns = 100'000'000;

  void accepted(std::int64_t kick_id, std::int64_t fired_t_ns) { receipts_.push_back({kick_id, fired_t_ns}); }

  /// The kick whose receipt is the nearest to a pulse at t_ns, once; none: no receipt is as near as kFarthest_ns.
  std::optional<std::int64_t> take(std::int64_t t_ns) {
    const auto distance_ns = [t_ns](const Receipt& receipt) { return std::abs(receipt.t_ns - t_ns); };
    const auto nearest = std::ranges::min_element(receipts_, {}, distance_ns);
    if (nearest == receipts_.end() || distance_ns(*nearest) > kFarthest_ns) return std::nullopt;
    const std::int64_t kick_id = nearest->kick_id;
    receipts_.erase(receipts_.begin(), nearest + 1);  // of those before it no pulse will come any more
    return kick_id;
  }

 private:
  struct Receipt {
    std::int64_t kick_id;
    std::int64_t t_ns;
  };
  std::vector<Receipt> receipts_;
};

}  // namespace trivela::nodes
