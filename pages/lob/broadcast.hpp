#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <condition_variable>
#include <mutex>

namespace trivela::pages {

/// What a page follows. A frame may be skipped; the others are snapshots of a whole, so that the newest says all.
enum class Channel { kSetup, kLobs, kStatus, kFrame };

/// The newest message of each channel, encoded once and shared by all viewers. Any thread.
class Broadcast {
 public:
  static constexpr std::size_t kChannels = 4;
  using Message = std::shared_ptr<const std::string>;
  using Seen = std::array<std::uint64_t, kChannels>;  ///< a viewer's last version of each channel; begins with zeros

  /// `json` becomes the channel's newest server-sent event.
  void publish(Channel channel, const std::string& json);

  /// The newest message of each channel that `seen` does not have, in the order of the channels; waits for one up to
  /// `timeout`. Empty: none came, or closed().
  std::vector<Message> wait(Seen& seen, std::chrono::nanoseconds timeout);

  /// Lets go of all who wait.
  void close();
  bool closed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Message, kChannels> newest_{};
  Seen versions_{};
  bool closed_ = false;
};

}  // namespace trivela::pages
