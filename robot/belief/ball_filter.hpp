#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <optional>

#include "config/settings.hpp"

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

/// Where the ball is in R and whether the robot has it.
///
/// The position is low-passed with `ball_time_constant_s`; a jump of more than half a metre starts again. Possession
/// begins and ends when the handler test has said the same for `possession_debounce_s`; a ball not seen for
/// `ball_forget_s` is unknown and not possessed. All times are exposures.
class BallFilter {
 public:
  /// `handler_y_m`: resting place of the ball centre before the robot's centre.
  BallFilter(const config::WorldState& settings, double handler_y_m)
      : settings_(settings), decay_(settings.ball_time_constant_s), handler_{0.0, handler_y_m} {}

  /// One frame; nullopt when the ball was not seen.
  void observe(std::int64_t t_exposure_ns, const std::optional<Eigen::Vector2d>& ball_m);

  /// No frame has come since the last one for silence_s: what was not seen is forgotten by the same limits.
  void silence(double silence_s);

  /// Position in R at the last exposure; nullopt when unknown.
  const std::optional<Eigen::Vector2d>& position_m() const { return position_m_; }

  /// Exposure of the last sighting.
  std::int64_t seen_t_ns() const { return seen_t_ns_; }

  bool possession() const { return possession_; }

 private:
  bool in_handler() const;

  config::WorldState settings_;
  Decay decay_;
  Eigen::Vector2d handler_;
  std::optional<Eigen::Vector2d> position_m_;
  std::int64_t seen_t_ns_ = 0;
  bool possession_ = false;
  std::optional<std::int64_t> differs_since_ns_;
};

}  // namespace trivela::robot
