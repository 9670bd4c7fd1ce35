#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace trivela::robot {

/// What a robot's count of its possessions goes by, at one instant.
struct PossessionSigns {
  std::int64_t t_ns = 0;
  std::uint8_t half = 0;
  bool playing = false;      ///< the referee's word
  double half_time_s = 0.0;  ///< since the half's first start of play; not finite: not known
  bool possession = false;   ///< the ball lies in the handler
  std::int64_t kick_id = 0;  ///< the last kick given to the device; 0: none
};

/// Numbers a robot's possessions of the ball, from 1 in each half, in the order in which it has them.
///
/// A possession ends with the referee's stop, with a kick, and where the ball was away for half a second: a ball that
/// bounces in the handler, and one that the camera loses for less, is the same possession. The next one begins with the
/// stop, in which the ball is laid in the handler, or where the robot has the ball again. One that was never in play
/// keeps its number for the next: what is numbered was played, but for the last of a half.
///
/// Who begins to count in the middle of a half (a node that was started again) goes on from the tenth of a second of
/// the half, which no count has come to: nobody has the ball twice in it.
class PossessionCount {
 public:
  /// The possession of these signs: the one that the robot has, or had last in this play, or will have.
  std::uint32_t see(const PossessionSigns& now) {
    if (half_ != now.half) begin_half(now);
    if (playing_ && !now.playing) begin_next();
    playing_ = now.playing;
    if (kick_id_ != now.kick_id) kicked_t_ns_ = now.t_ns;
    kick_id_ = now.kick_id;
    if (now.possession) {
      hold(now);
    } else if (held_) {
      leave(now.t_ns);
    }
    return number_;
  }

 private:
  static constexpr std::int64_t kLost_ns = 500'000'000;      // away for so long it is another possession
  static constexpr std::int64_t kLeaves_ns = 1'000'000'000;  // a ball that was kicked has left the handler (assumed)
  static constexpr double kTenths_per_s = 10.0;
  static constexpr double kLongest_s = 1e8;  // a number has 32 bit

  void begin_half(const PossessionSigns& now) {
    half_ = now.half;
    const bool under_way = now.half_time_s > 0.0 && now.half_time_s < kLongest_s;
    number_ = 1 + (under_way ? static_cast<std::uint32_t>(std::ceil(kTenths_per_s * now.half_time_s)) : 0);
    playing_ = played_ = held_ = kicked_ = false;
  }

  void begin_next() {
    if (played_) ++number_;
    played_ = kicked_ = false;
  }

  void hold(const PossessionSigns& now) {
    if (kicked_ || now.t_ns - held_t_ns_ >= kLost_ns) begin_next();
    played_ = played_ || now.playing;
    held_ = true;
    held_t_ns_ = now.t_ns;
  }

  void leave(std::int64_t t_ns) {
    held_ = false;
    if (kicked_t_ns_) kicked_ = t_ns - *kicked_t_ns_ <= kLeaves_ns;
    kicked_t_ns_.reset();
  }

  std::optional<std::uint8_t> half_;
  std::uint32_t number_ = 0;
  bool playing_ = false;
  bool played_ = false;  // in play the robot had the ball of this number
  bool held_ = false;
  bool kicked_ = false;  // it has left by a kick
  std::int64_t held_t_ns_ = 0;
  std::int64_t kick_id_ = 0;
  std::optional<std::int64_t> kicked_t_ns_;  // none: or the ball has left since
};

}  // namespace trivela::robot
