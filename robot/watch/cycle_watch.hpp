#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trivela::robot {

/// Knows in lockstep when a cycle is recorded: once every stream that has a sample a cycle has brought it. Their
/// writers keep the last sample only, so that the next cycle must not begin before.
class CycleWatch {
 public:
  /// One more stream to wait for; returns its number.
  std::size_t add() {
    latest_t_ns_.push_back(kNothing);
    return latest_t_ns_.size() - 1;
  }

  /// The cycle that is complete with this sample; none if it is not, or was before.
  std::optional<std::int64_t> see(std::size_t stream, std::int64_t t_ns) {
    latest_t_ns_[stream] = std::max(latest_t_ns_[stream], t_ns);
    const std::int64_t complete = *std::min_element(latest_t_ns_.begin(), latest_t_ns_.end());
    if (complete <= reported_t_ns_) return std::nullopt;
    reported_t_ns_ = complete;
    return complete;
  }

 private:
  static constexpr std::int64_t kNothing = -1;
  std::vector<std::int64_t> latest_t_ns_;
  std::int64_t reported_t_ns_ = kNothing;
};

}  // namespace trivela::robot
