#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/participant.hpp"

namespace trivela::bus {

/// A topic stays silent though its reader was made again several times: only a new participant may help.
class BusUnresponsive : public Error {
 public:
  using Error::Error;
};

/// What the readers of one participant know together about what they do not hear, in real time; for bus/ alone. For
/// any thread.
class ReaderHealth {
 public:
  explicit ReaderHealth(RealTime options)
      : warn_(std::move(options.warn)), stays_until_(std::chrono::steady_clock::now() + options.stay) {}

  /// A reader of a topic with a period was made again.
  void renewed(const std::string& sentence) {
    ++renewals_;
    if (warn_) warn_(sentence);
  }

  /// Readers that have no period to miss are made again with those that have: counts the latter.
  std::uint64_t renewals() const { return renewals_; }

  /// Making readers again does not help; the first topic's name and reason are kept.
  void give_up(const std::string& topic, const std::string& timeline) {
    if (std::chrono::steady_clock::now() < stays_until_) return;
    const std::lock_guard lock(mutex_);
    if (!deaf_) deaf_.emplace("hear", topic, timeline);
  }

  /// The timeline of who gave up first.
  std::optional<BusUnresponsive> deaf() const {
    const std::lock_guard lock(mutex_);
    return deaf_;
  }

 private:
  std::function<void(const std::string&)> warn_;
  std::chrono::steady_clock::time_point stays_until_;
  std::atomic<std::uint64_t> renewals_ = 0;
  mutable std::mutex mutex_;
  std::optional<BusUnresponsive> deaf_;
};

}  // namespace trivela::bus
