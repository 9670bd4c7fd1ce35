#pragma once

#include <cstdint>
#include <vector>

namespace trivela::pages {

/// Where a replay stands, by its own clock: speed 1 is real time, a negative speed plays backwards.
class Player {
 public:
  /// Start of each scan, rising; one at least.
  explicit Player(std::vector<std::int64_t> t_ns);

  std::size_t position() const { return position_; }
  bool playing() const { return playing_; }
  double speed() const { return speed_; }

  /// Begins again where it has come to its end.
  void play();
  void pause() { playing_ = false; }
  void set_speed(double speed) { speed_ = speed; }

  /// Goes to a scan; past the ends, to them.
  void seek(std::int64_t position);

  /// `passed_s` of the wall clock have passed; stops at the ends.
  void advance(double passed_s);

 private:
  std::vector<std::int64_t> t_ns_;
  std::size_t position_ = 0;
  double now_s_ = 0.0;  // since the first scan
  double speed_ = 1.0;
  bool playing_ = false;
};

}  // namespace trivela::pages
