#include "robot/belief/ball_filter.hpp"

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double kNewBall_m = 0.5;

}  // namespace

bool BallFilter::in_handler() const {
  if (!position_m_) return false;
  const Eigen::Vector2d off = *position_m_ - handler_;
  return std::abs(off.x()) <= settings_.handler_half_width_m && std::abs(off.y()) <= settings_.handler_reach_m;
}

void BallFilter::observe(std::int64_t t_exposure_ns, const std::optional<Eigen::Vector2d>& ball_m) {
  if (ball_m && ball_m->allFinite()) {
    const double dt_s = kicking::seconds(t_exposure_ns - seen_t_ns_);
    const bool again = !position_m_ || dt_s <= 0.0 || (*ball_m - *position_m_).norm() > kNewBall_m;
    const double gain = again ? 1.0 : decay_.gain(dt_s);
    position_m_ = again ? *ball_m : Eigen::Vector2d{*position_m_ + gain * (*ball_m - *position_m_)};
    seen_t_ns_ = t_exposure_ns;
  }
  const double unseen_s = kicking::seconds(t_exposure_ns - seen_t_ns_);
  if (unseen_s > settings_.ball_forget_s) position_m_.reset();
  if (unseen_s > settings_.possession_forget_s) possession_ = false;
  if (in_handler() == possession_ || unseen_s > settings_.possession_forget_s) {
    differs_since_ns_.reset();
    return;
  }
  if (!differs_since_ns_) differs_since_ns_ = t_exposure_ns;
  if (kicking::seconds(t_exposure_ns - *differs_since_ns_) >= settings_.possession_debounce_s) {
    possession_ = !possession_;
    differs_since_ns_.reset();
  }
}

void BallFilter::silence(double silence_s) {
  if (silence_s > settings_.ball_forget_s) position_m_.reset();
  if (silence_s <= settings_.possession_forget_s) return;
  possession_ = false;
  differs_since_ns_.reset();
}

}  // namespace trivela::robot
