#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "bus/domain/domain.hpp"
#include "bus/node.hpp"
#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {

/// From the thread of one bus to that of the other, so that neither ever waits for the other: of what nobody takes, the
/// latest kMost are kept.
template <class T>
class BoundedQueue {
 public:
  static constexpr std::size_t kMost = 64;

  void put(T value) {
    {
      const std::lock_guard lock{mutex_};
      values_.push_back(std::move(value));
      if (values_.size() > kMost) values_.pop_front();
    }
    filled_.notify_one();
  }

  /// The oldest, waiting for one no longer than the timeout.
  std::optional<T> next(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    if (!filled_.wait_for(lock, timeout, [this] { return !values_.empty(); })) return std::nullopt;
    std::optional<T> value{std::move(values_.front())};
    values_.pop_front();
    return value;
  }

  void clear() {
    const std::lock_guard lock{mutex_};
    values_.clear();
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  std::deque<T> values_;
};

/// A machine's membership of the team's bus, in threads of its own. It begins when the interface has an address, ends
/// with it and begins again with the next; also where nothing is heard for long, since a multicast group may forget a
/// member. What is said meanwhile is not said. Nothing that happens to it is an error of the node.
class TeamMember {
 public:
  /// What is said on the team's bus.
  using TeamMessage = std::variant<msg::TeamState, msg::Referee>;

  /// A word with the instant at which it came, by this machine's clock.
  struct ReceivedMessage {
    TeamMessage word;
    std::int64_t t_ns;
  };

  /// `domain`: of the team's bus. `own`: the participant's number. `referee`: listens to it. The context outlives it.
  TeamMember(const NodeContext& context, bus::DomainConfig domain, std::uint8_t own, bool referee);
  TeamMember(const TeamMember&) = delete;
  TeamMember& operator=(const TeamMember&) = delete;
  ~TeamMember();

  void say(const TeamMessage& word) { said_.put(word); }

  /// What others said next, waiting no longer than the timeout.
  std::optional<ReceivedMessage> next(std::chrono::nanoseconds timeout) { return received_.next(timeout); }

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  void be_member(const std::string& address);
  void listen(bus::Node& node);
  void look_after(const std::string& address, bus::Stop& over);
  std::optional<std::string> address() const;
  void note_obstacle(const std::string& obstacle);

  const NodeContext& context_;
  const bus::DomainConfig domain_;
  const std::string owner_;
  const bool listens_to_referee_;
  BoundedQueue<TeamMessage> said_;
  BoundedQueue<ReceivedMessage> received_;
  std::atomic<Clock::time_point> last_received_{Clock::time_point{}};
  Clock::duration timeout_;
  std::string obstacle_;  // that was told last
  bus::Stop ends_;        // with the object
  std::thread thread_;
};

}  // namespace trivela::nodes
