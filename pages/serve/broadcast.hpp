#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <condition_variable>
#include <mutex>

namespace trivela::pages {

/// The newest message of each of a page's channels, encoded once and shared by all viewers: who is slow skips messages
/// and never sees an old one. Any thread.
class Broadcast {
 public:
  using Message = std::shared_ptr<const std::string>;
  using Seen = std::vector<std::uint64_t>;  ///< a viewer's last version of each channel; begins empty

  /// `channels`: their names as events, in the order in which a viewer is given them.
  explicit Broadcast(std::vector<std::string> channels);

  /// `json` becomes the newest server-sent event of the channel of that place in the list.
  void publish(std::size_t channel, const std::string& json);

  /// The newest message of each channel that `seen` does not have, in the order of the channels; waits for one up to
  /// `timeout`. Empty: none came, or closed().
  std::vector<Message> wait(Seen& seen, std::chrono::nanoseconds timeout);

  /// Lets go of all who wait.
  void close();
  bool closed() const;

 private:
  const std::vector<std::string> names_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Message> newest_;
  Seen versions_;
  bool closed_ = false;
};

}  // namespace trivela::pages
