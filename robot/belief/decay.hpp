#pragma once

#include <cmath>

namespace trivela::robot {

/// Gain of a low-pass over a step: 1 - exp(-dt / tau). Cycles are alike, so that the last one's is kept.
class Decay {
 public:
  explicit Decay(double time_constant_s) : time_constant_s_(time_constant_s) {}

  double gain(double dt_s) {
    if (dt_s != dt_s_) {
      dt_s_ = dt_s;
      gain_ = 1.0 - std::exp(-dt_s / time_constant_s_);
    }
    return gain_;
  }

 private:
  double time_constant_s_;
  double dt_s_ = 0.0;
  double gain_ = 0.0;
};

}  // namespace trivela::robot
