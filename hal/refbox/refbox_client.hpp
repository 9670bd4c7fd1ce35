#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "hal/line/line.hpp"
#include "hal/refbox/words.hpp"

namespace trivela::hal::refbox {

/// How long the oldest bytes that were given to a connection have waited for the other side's acknowledgement. A peer
/// that acknowledges a little is as good as its slowest byte.
class Unacknowledged {
 public:
  using Instant = std::chrono::steady_clock::time_point;

  /// So many bytes more were given to the connection.
  void sent(std::size_t bytes, Instant at) {
    sent_bytes_ += bytes;
    writes_.push_back({sent_bytes_, at});
  }

  /// The age of the oldest of them at `now`, when `waiting_bytes` are not acknowledged; 0: all are.
  std::chrono::nanoseconds age(std::size_t waiting_bytes, Instant now) {
    const std::uint64_t acknowledged_bytes = sent_bytes_ - std::min<std::uint64_t>(waiting_bytes, sent_bytes_);
    while (!writes_.empty() && writes_.front().end_bytes <= acknowledged_bytes) writes_.pop_front();
    return writes_.empty() ? std::chrono::nanoseconds{0} : now - writes_.front().at;
  }

 private:
  struct Written {
    std::uint64_t end_bytes;
    Instant at;
  };
  std::uint64_t sent_bytes_ = 0;
  std::deque<Written> writes_;
};

/// The port of the league's box (RoboCup-MSL/RefBox).
inline constexpr std::uint16_t kLeaguePort = 28097;

struct Connected {};

/// The connection has ended, or it has never been there: `why` as a clause.
struct Lost {
  std::string why;
};

/// A box that cannot be reached: said once until it is reached or the reason changes.
struct Unreachable {
  std::string why;
};

using BoxEvent = std::variant<Connected, Command, NoCommand, Lost, Unreachable>;

/// A team's end of the connection to a referee box. It connects, and connects again kRetry after a failure. A
/// connection is lost when the box closes or resets it and when what we sent waits for longer than `timeout` to be
/// acknowledged; that the box itself says nothing is no fault. For one thread.
class RefboxClient {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kRetry{500};
  /// After the box has turned us away: some boxes say that to every team (RoboCup-MSL/RefBox, mslrb2015/Comms.pde).
  static constexpr std::chrono::seconds kRetryTurnedAway{2};
  static constexpr std::chrono::seconds kLongestAttempt{2};  ///< a host that is switched off answers nothing

  RefboxClient(std::unique_ptr<Line> line, TeamMarks team, std::chrono::nanoseconds timeout);

  /// The next event; waits for it up to `timeout`. None: nothing happened.
  std::optional<BoxEvent> next(std::chrono::nanoseconds timeout);

  bool connected() const { return connected_; }

  /// Sends an object with its NUL, where there is a connection. One that does not take all of it is lost.
  void send(std::string_view object);

  /// "tcp://127.0.0.1:28097".
  const std::string& box() const { return line_->name(); }

 private:
  void open(Clock::time_point deadline);
  void refused(std::string why);
  void receive(Clock::time_point deadline);
  void look_at_acknowledgements();
  void lose(std::string why);

  std::unique_ptr<Line> line_;
  TeamMarks team_;
  std::chrono::nanoseconds timeout_;
  bool connected_ = false;
  bool accepted_ = false;     // the box has said a word on this connection that is no RESET
  bool turned_away_ = false;  // it has said RESET and nothing else
  std::deque<BoxEvent> events_;
  CommandStream words_;
  Unacknowledged unacknowledged_;
  Clock::time_point retry_at_{};
  std::optional<Clock::time_point> attempt_since_;
  std::string said_;  // why the box could not be reached, as it was said last
};

/// The same over TCP; `host` is a name or an address.
std::unique_ptr<RefboxClient> refbox_client(const std::string& host, std::uint16_t port, TeamMarks team,
                                            std::chrono::nanoseconds timeout);

}  // namespace trivela::hal::refbox
