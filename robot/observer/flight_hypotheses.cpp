#include "robot/observer/flight_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "kicking/constants.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

constexpr double kReleaseDoubt_s = 0.04;  // until then the ball may be in the handler still
constexpr double kLatestRelease_s = 0.4;  // after the expected one: a delay of 0.25 s that nobody measured, +- 0.06 s
constexpr double kLateRelease = 0.05;     // how often, before anything is seen, the ball leaves as late as that
constexpr double kCarried_mps = 2.5;      // as fast as a robot carries the ball, along either axis
constexpr std::size_t kFewestInFlight = 3;
constexpr double kOnFloorBelow_m = 0.25;  // a ball that never was higher rolls
constexpr double kNoise_sd = 4.0;         // a sighting so far off is not noise
constexpr double kLowClimb_mps = 1.65;    // which rises as high as that
constexpr double kUsualClimb_mps = 4.0;   // where the expected one is not known
constexpr double kMostMisfit = 30.0;      // squared, of one sighting: more is a false detection
constexpr double kTurnKeeps = 0.2;        // of the speed over ground, on average over where the body is hit ...
constexpr double kTurnSd = 0.5;           // ... and its spread along either axis, in speeds of the ball
constexpr std::size_t kLateTurns = 3;     // too late to show in a misfit
constexpr double kSuspicious = 12.0;      // misfit of three sightings; 6 on average
constexpr double kFrameKeeps = 0.45, kFrameKeepsSd = 0.15;  // of the speed: post, bar or a keeper; assumption
constexpr double kNetArea_m2 = 6.0;                         // where a ball behind the line may be that the net holds

double log_density(const std::array<double, 3>& misfit, double log_variance) {
  const double square = std::min(misfit[0] + misfit[1], kMostMisfit);
  return -0.5 * (square + log_variance) - std::log(2.0 * std::numbers::pi);
}

/// ln of the normal density of one number, whose squared distance from the mean is `square` variances.
double log_density_of_one(double square, double variance) {
  return -0.5 * (std::min(square, kMostMisfit) + std::log(2.0 * std::numbers::pi * variance));
}

bool is_low(const kicking::Sighting& sighting) { return sighting.ball_m.z() < kOnFloorBelow_m; }

/// A kick that was not expected to rise over kOnFloorBelow_m.
bool kicked_low(const ShotTrack& track) {
  return track.expected_climb_mps && *track.expected_climb_mps < kLowClimb_mps;
}

/// Heights tell when a lob left the floor, as long as that is open.
bool height_tells(const ShotTrack& track, const kicking::Sighting& sighting) {
  return !kicked_low(track) && kicking::seconds(sighting.t_ns - track.release_t_ns) <= kLatestRelease_s;
}

FlightFilter::Way way_of(const ShotTrack& track, std::span<const kicking::Sighting> seen) {
  if (kicked_low(track)) {
    const double below_m = kOnFloorBelow_m + kNoise_sd * track.ball_sd_m;
    const bool stays = std::ranges::all_of(seen, [=](const auto& s) { return s.ball_m.z() < below_m; });
    return stays ? FlightFilter::Way::kSlides : FlightFilter::Way::kFlies;
  }
  return std::ranges::all_of(seen, is_low) ? FlightFilter::Way::kRolls : FlightFilter::Way::kFlies;
}

/// The crossing ahead of a ball, or just behind it; none: it does not come there within `within_s`.
std::optional<PlaneCrossing> meets_plane(const FlightFilter& from, double t_s, double goal_y_m, double within_s) {
  FlightFilter ball = from;
  double ahead_s = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double v = ball.y().v_mps;
    if (v < 0.1) return std::nullopt;
    const double step_s = (goal_y_m - ball.y().p_m) / v;
    if (ahead_s + step_s > within_s) return std::nullopt;
    if (step_s <= 0.0) break;
    ball.advance(step_s);
    ahead_s += step_s;
  }
  const double v = ball.y().v_mps;
  if (v < 0.1) return std::nullopt;
  const double rest_s = (goal_y_m - ball.y().p_m) / v;
  const double sd_y_m = std::sqrt(ball.y().var_p_m2);
  const auto sd = [&](const AxisState& s) { return std::hypot(std::sqrt(s.var_p_m2), s.v_mps / v * sd_y_m); };
  return PlaneCrossing{t_s + ahead_s + rest_s,
                       sd_y_m / v,
                       ball.x().p_m + ball.x().v_mps * rest_s,
                       sd(ball.x()),
                       std::max(kicking::Ball{}.radius_m, ball.z().p_m + ball.z().v_mps * rest_s),
                       sd(ball.z()),
                       ball};
}

class Hypotheses {
 public:
  /// Of a ball that left at `launch_t_ns`, seen from then on.
  Hypotheses(const ShotTrack& track, std::span<const kicking::Sighting> seen, double goal_y_m, std::int64_t launch_t_ns)
      : track_(track), seen_(seen), goal_y_m_(goal_y_m), launch_t_ns_(launch_t_ns), way_(way_of(track, seen)) {
    free_.reserve(seen.size());
    misfit_.reserve(seen.size());
    log_free_.reserve(seen.size());
  }

  FlightHypotheses tell() {
    free_flight();
    FlightHypotheses told{.crossing = crossing_,
                          .seen_after_crossing = before_line_ < seen_.size(),
                          .turns = {},
                          .last = free_.back(),
                          .last_t_s = time_s(before_line_ - 1),
                          .residual_sd_m = residual_sd_m()};
    if (!told.crossing) told.crossing = meets_plane(free_.back(), told.last_t_s, goal_y_m_, kFar_s);
    if (crossing_) {
      told.log_passed = std::max(continued(free_.back(), before_line_ - 1, true), held_by_the_net());
      FlightFilter back = crossing_->ball;
      back.throw_back(goal_y_m_, kFrameKeeps, kFrameKeepsSd);
      told.log_thrown_back = thrown_back(back);
    }
    for (std::size_t i = 0; i < before_line_; ++i) {
      if (may_turn_after(i)) told.turns.push_back(turn_after(i));
    }
    return told;
  }

  /// ln of the likelihood of all sightings but the first, by the best of the hypotheses that tell() gave.
  double log_likelihood(const FlightHypotheses& told) const {
    return log_height_ + log_free_.back() + std::max(log_untouched(told), log_turned(told));
  }

 private:
  static constexpr double kFar_s = 10.0;

  // Against free flight up to the last sighting before the line.
  static double log_untouched(const FlightHypotheses& told) {
    return told.crossing && told.seen_after_crossing ? std::max(told.log_passed, told.log_thrown_back) : 0.0;
  }
  static double log_turned(const FlightHypotheses& told) {
    double best = -HUGE_VAL;
    for (const Turn& turn : told.turns) best = std::max(best, turn.log_likelihood + std::log(kTurned));
    return best;
  }

  double time_s(std::size_t i) const { return kicking::seconds(seen_[i].t_ns - track_.release_t_ns); }

  FlightFilter start() const {
    const Eigen::Vector3d& first = seen_.front().ball_m;
    Eigen::Vector2d to_goal{-first.x(), std::max(1.0, goal_y_m_ - first.y())};
    to_goal.normalize();
    const double v = track_.expected_speed_mps;
    const double flown_s = kicking::seconds(seen_[0].t_ns - launch_t_ns_);
    const double climb = track_.expected_climb_mps.value_or(kUsualClimb_mps) - kicking::kGravity_mps2 * flown_s;
    const double sd_climb = track_.expected_climb_mps ? 0.1 * *track_.expected_climb_mps + 0.3 : 5.0;
    // The robot's own speed, and where it aims. A lob that never left the floor was no kick as expected.
    const double sd = way_ == FlightFilter::Way::kRolls ? v + 1.0 : 0.1 * v + 1.2;
    return {seen_.front(), track_.ball_sd_m, {v * to_goal.x(), v * to_goal.y(), climb}, {sd, sd, sd_climb}, way_};
  }

  void free_flight() {
    free_.push_back(start());
    misfit_.push_back(0.0);
    log_free_.push_back(0.0);
    for (before_line_ = 1; before_line_ < seen_.size(); ++before_line_) {
      FlightFilter ball = free_.back();
      const double t_s = time_s(before_line_ - 1), dt_s = time_s(before_line_) - t_s;
      if (ball.y().p_m + 1.05 * dt_s * ball.y().v_mps > goal_y_m_) crossing_ = meets_plane(ball, t_s, goal_y_m_, dt_s);
      if (crossing_) return;
      ball.advance(dt_s);
      const double height_m2 = ball.z().var_p_m2 + track_.ball_sd_m * track_.ball_sd_m;
      const auto misfit = ball.correct(seen_[before_line_].ball_m, track_.ball_sd_m);
      if (height_tells(track_, seen_[before_line_])) log_height_ += log_density_of_one(misfit[2], height_m2);
      squares_ += misfit[0] + misfit[1] + misfit[2];
      misfit_.push_back(std::min(misfit[0] + misfit[1], kMostMisfit));
      log_free_.push_back(log_free_.back() + log_density(misfit, ball.log_variance()));
      free_.push_back(ball);
    }
  }

  /// ln of the likelihood of all sightings after number `i`, whose ball it is.
  double continued(FlightFilter ball, std::size_t i, bool advance_first, double from_s = 0.0) const {
    double sum = 0.0;
    for (++i; i < seen_.size(); ++i) {
      if (advance_first) ball.advance(time_s(i) - (from_s > 0.0 ? from_s : time_s(i - 1)));
      from_s = 0.0;
      advance_first = true;
      const auto misfit = ball.correct(seen_[i].ball_m, track_.ball_sd_m);
      sum += log_density(misfit, ball.log_variance());
    }
    return sum;
  }

  double thrown_back(const FlightFilter& back) const {
    return continued(back, before_line_ - 1, true, std::max(crossing_->t_s, 1e-9));
  }

  double held_by_the_net() const {
    double sum = 0.0;
    for (std::size_t i = before_line_; i < seen_.size(); ++i) {
      const double before = std::max(0.0, goal_y_m_ - seen_[i].ball_m.y()) / track_.ball_sd_m;
      sum -= 0.5 * std::min(before * before, kMostMisfit) + std::log(kNetArea_m2);
    }
    return sum;
  }

  bool may_turn_after(std::size_t i) const {
    if (i + 1 >= seen_.size()) return false;
    if (i == 0 || i + kLateTurns >= before_line_) return true;
    return misfit_[i + 1] + misfit_[i + 2] + misfit_[i + 3] > kSuspicious;
  }

  Turn turn_after(std::size_t i) const {
    FlightFilter ball = free_[i];
    const double dt_s = time_s(i + 1) - time_s(i);
    const Eigen::Vector2d v{ball.x().v_mps, ball.y().v_mps};
    ball.advance(dt_s);
    ball.turn((kTurnKeeps - 1.0) * v, kTurnSd * v.norm(), dt_s);
    const bool last = crossing_ && i + 1 == before_line_;
    const double within_s = last ? std::max(0.0, crossing_->t_s - time_s(i)) : dt_s;
    Turn turn{within_s, continued(ball, i, false) - (log_free_.back() - log_free_[i])};
    const AxisState& y = free_[i].y();
    if (y.p_m + y.v_mps * dt_s > goal_y_m_ - kKeeperDepth_m)
      turn.crossing = meets_plane(free_[i], time_s(i), goal_y_m_, kFar_s);
    return turn;
  }

  double residual_sd_m() const {
    const double n = 3.0 * static_cast<double>(before_line_ - 1);
    return n > 0.0 ? track_.ball_sd_m * std::sqrt(squares_ / n) : 0.0;
  }

  const ShotTrack& track_;
  std::span<const kicking::Sighting> seen_;
  double goal_y_m_;
  std::int64_t launch_t_ns_;
  FlightFilter::Way way_;
  std::vector<FlightFilter> free_;  // after each sighting before the line
  std::vector<double> misfit_;
  std::vector<double> log_free_;  // of all sightings up to this one
  double log_height_ = 0.0;       // of those whose height tells of the release
  double squares_ = 0.0;
  std::size_t before_line_ = 0;  // how many sightings are
  std::optional<PlaneCrossing> crossing_;
};

/// ln of the density of a sighting after another one: meanwhile the ball was moved over ground by N(0, sd^2) an axis,
/// and rose from the floor with `climb_mps` for half of the time, more or less.
double log_moved(const ShotTrack& track, const kicking::Sighting& from, const kicking::Sighting& to, double sd_mps,
                 double climb_mps) {
  const double dt_s = kicking::seconds(to.t_ns - from.t_ns), noise_m2 = track.ball_sd_m * track.ball_sd_m;
  const double var_m2 = std::pow(sd_mps * dt_s, 2) + 2.0 * noise_m2;
  const double square = (to.ball_m - from.ball_m).head<2>().squaredNorm() / var_m2;
  const double log_over_ground = log_density({square, 0.0, 0.0}, 2.0 * std::log(var_m2));
  if (!height_tells(track, to)) return log_over_ground;
  const double rose_m = 0.5 * climb_mps * dt_s, height_m2 = noise_m2 + rose_m * rose_m;
  const double above_m = to.ball_m.z() - kicking::Ball{}.radius_m - rose_m;
  return log_over_ground + log_density_of_one(above_m * above_m / height_m2, height_m2);
}

/// How many of the first sightings may show the ball in the handler still: on the floor, and no faster than a robot.
std::size_t held_at_first(const ShotTrack& track, std::span<const kicking::Sighting> seen) {
  const double below_m = std::max(kOnFloorBelow_m, kicking::Ball{}.radius_m + kNoise_sd * track.ball_sd_m);
  const double noise_m = kNoise_sd * std::numbers::sqrt2 * track.ball_sd_m;
  std::size_t held = 0;
  for (; held < seen.size() && seen[held].ball_m.z() < below_m; ++held) {
    if (kicking::seconds(seen[held].t_ns - track.release_t_ns) > kLatestRelease_s) break;
    if (held == 0) continue;
    const double dt_s = kicking::seconds(seen[held].t_ns - seen[held - 1].t_ns);
    const double moved_m = (seen[held].ball_m - seen[held - 1].ball_m).head<2>().norm();
    if (moved_m > kCarried_mps * dt_s + noise_m) break;
  }
  return kicked_low(track) || !std::ranges::all_of(seen, is_low) ? held : 0;
}

}  // namespace

std::optional<FlightHypotheses> flight_hypotheses(const ShotTrack& track, double goal_y_m) {
  const auto left = std::find_if(track.sightings.begin(), track.sightings.end(), [&](const kicking::Sighting& s) {
    return kicking::seconds(s.t_ns - track.release_t_ns) >= kReleaseDoubt_s;
  });
  const std::span<const kicking::Sighting> seen{left, track.sightings.end()};
  if (seen.size() < kFewestInFlight) return std::nullopt;
  Hypotheses expected{track, seen, goal_y_m, track.release_t_ns};
  FlightHypotheses best = expected.tell();
  double log_best = expected.log_likelihood(best), log_held = std::log(kLateRelease);
  // The robot's file may have a delay that is too short: the ball then leaves after some sightings.
  const std::size_t held = held_at_first(track, seen);
  for (std::size_t first = 1; first <= held && seen.size() - first >= kFewestInFlight; ++first) {
    const double leaves = log_moved(track, seen[first - 1], seen[first], 0.6 * track.expected_speed_mps,
                                    track.expected_climb_mps.value_or(kUsualClimb_mps));
    Hypotheses late{track, seen.subspan(first), goal_y_m, std::midpoint(seen[first - 1].t_ns, seen[first].t_ns)};
    FlightHypotheses told = late.tell();
    if (const double log_all = log_held + leaves + late.log_likelihood(told); log_all > log_best) {
      log_best = log_all;
      best = std::move(told);
    }
    log_held += log_moved(track, seen[first - 1], seen[first], kCarried_mps, 0.0);
  }
  return best;
}

}  // namespace trivela::robot
