#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace trivela::robot {

/// How far another machine's steady clock is ahead.
struct OffsetEstimate {
  std::int64_t offset_ns = 0;  ///< the other's clock minus this one
  std::int64_t error_ns = 0;   ///< it lies within plus and minus so much
};

/// Whether it may be a reading of a steady clock: no machine runs for 36 years.
constexpr bool is_instant(std::int64_t t_ns) { return t_ns >= 0 && t_ns < std::int64_t{1} << 60; }

/// Two readings of one message on its way.
struct Passage {
  std::int64_t sent_t_ns = 0;      ///< by the sender's clock
  std::int64_t received_t_ns = 0;  ///< by the receiver's
};

/// Compares this machine's clock with another's, by messages in both directions of which each takes its own time.
///
/// The other's clock is ahead by o. One of its messages that took d seems to take f = heard - sent = d - o, one of ours
/// g = d' + o. So o = (g - f) / 2 + (d - d') / 2. The second term is at most (d + d') / 2 = (g + f) / 2, half the round
/// trip, since no message takes less than nothing. Of all messages of a window those that took least
/// are the best, each direction by itself. The two clocks part by kLargestDrift, so an older message is worth less by
/// what they may have parted since, and so much is added to the error. As NTP's clock filter (RFC 5905, section 10),
/// which looks at round trips where this looks at single ways.
class ClockExchange {
 public:
  static constexpr std::int64_t kWindow_ns = 10'000'000'000;
  static constexpr double kLargestDrift = 5e-5;  ///< in seconds a second

  /// One of the other's messages came. What is no instant of a steady clock is passed over.
  void received(const Passage& theirs);

  /// The other says when one of ours arrived; the same one may be told again.
  void told(const Passage& ours);

  /// Of the other's messages the one that took least, which it is told; none: none came in the window.
  std::optional<Passage> quickest(std::int64_t now_ns) const;

  /// None: no message of one direction lately. Where the two contradict each other, since one of the clocks was set or
  /// stood still, all is forgotten.
  std::optional<OffsetEstimate> estimate(std::int64_t now_ns);

 private:
  struct Way {
    std::int64_t here_t_ns = 0;  // by this clock
    std::int64_t took_ns = 0;    // by two clocks
    Passage passage;
  };
  using Ways = std::deque<Way>;

  static const Way* best(const Ways& ways, std::int64_t now_ns);
  static void add(Ways& ways, const Way& way);

  Ways theirs_;
  Ways ours_;
};

}  // namespace trivela::robot
