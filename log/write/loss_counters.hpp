#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "log/schema/loss.hpp"

namespace trivela::log {

/// Counter of `loss` that `kind` names.
inline std::int64_t& counter(Loss& loss, LossKind kind) {
  switch (kind) {
    case LossKind::kLost:
      return loss.lost;
    case LossKind::kGaps:
      return loss.gaps;
    case LossKind::kOverflow:
      return loss.overflow;
    case LossKind::kNanRefused:
      return loss.nan_refused;
    case LossKind::kRejected:
      return loss.rejected;
    case LossKind::kOutOfOrder:
      break;
  }
  return loss.out_of_order;
}

/// Counters of every stream, for any thread.
class LossCounters {
 public:
  /// Adds the counters of `delta` to its stream and returns the sum.
  Loss add(const Loss& delta) {
    const std::lock_guard lock(mutex_);
    Loss& sum = streams_.try_emplace(delta.stream, Loss{.stream = delta.stream}).first->second;
    sum.received += delta.received;
    sum.lost += delta.lost;
    sum.gaps += delta.gaps;
    sum.overflow += delta.overflow;
    sum.nan_refused += delta.nan_refused;
    sum.rejected += delta.rejected;
    sum.out_of_order += delta.out_of_order;
    return sum;
  }

  std::vector<Loss> all() const {
    const std::lock_guard lock(mutex_);
    std::vector<Loss> losses;
    for (const auto& [stream, loss] : streams_) losses.push_back(loss);
    return losses;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, Loss, std::less<>> streams_;
};

}  // namespace trivela::log
