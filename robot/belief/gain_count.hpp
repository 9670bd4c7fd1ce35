#pragma once

#include <cstdint>
#include <optional>

namespace trivela::robot {

/// Numbers a robot's possessions of the ball where the referee counts none: a new one begins where the robot has the
/// ball after half a second or more without it, where play begins while it has the ball, and in another half. The
/// number is the tenth of a second of its beginning, so that it is another one also after the node was started anew.
class GainCount {
 public:
  /// The robot's possession at t_ns >= 0, or the last one; 0: it had none yet in this half.
  std::uint32_t see(std::int64_t t_ns, std::uint8_t half, bool playing, bool possession) {
    const bool play_begins = playing && !playing_;
    playing_ = playing;
    if (half != half_) {
      half_ = half;
      number_ = 0;
      held_t_ns_.reset();
    }
    if (!possession) return number_;
    if (!held_t_ns_ || play_begins || t_ns - *held_t_ns_ >= kLost_ns) number_ = number_at(t_ns);
    held_t_ns_ = t_ns;
    return number_;
  }

 private:
  static constexpr std::int64_t kLost_ns = 500'000'000;   // a ball that bounces in the handler is the same possession
  static constexpr std::int64_t kTenth_ns = 100'000'000;  // nobody gains the ball twice in it

  static std::uint32_t number_at(std::int64_t t_ns) { return static_cast<std::uint32_t>(1 + t_ns / kTenth_ns); }

  std::uint8_t half_ = 0;
  bool playing_ = false;
  std::uint32_t number_ = 0;
  std::optional<std::int64_t> held_t_ns_;
};

}  // namespace trivela::robot
