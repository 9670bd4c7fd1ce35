#include "kicking/learning/kicker_learner.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "kicking/outcome/crossing_spread.hpp"

namespace trivela::kicking {

LinearFlight linear_flight(const KickFlight& flight, const RobotModel& file, const KickerVector& offsets) {
  const double elevation_rad = file.exit_angle_at(flight.power) + offsets[kElevationPart];
  const double v = file.table.speed_for(flight.power) * std::exp(offsets[kSpeedPart]);
  const double c = std::cos(elevation_rad), s = std::sin(elevation_rad);
  const double omega = flight.twist.omega_radps;
  const double heading_rad = flight.release.heading_rad + omega * offsets[kDelayPart];

  const Eigen::Vector2d forward = direction(heading_rad);
  const Eigen::Vector2d right(forward.y(), -forward.x());
  const double front_mps = flight.twist.vy_mps, side_mps = flight.twist.vx_mps - omega * file.ball_offset_m;
  const Transfer& k = file.transfer_exact;
  const double carried_front = k.along_mps(front_mps) + offsets[kAlongPart] * front_mps;
  const double carried_side = (k.lateral + offsets[kSidewaysPart]) * side_mps;
  const Eigen::Vector2d kick = direction(heading_rad + file.direction_rad + offsets[kDirectionPart]);
  const Eigen::Vector2d left(-kick.y(), kick.x());

  const Eigen::Vector2d shown = flight.speed_mps * std::cos(flight.elevation_rad) * direction(flight.direction_rad);
  const Eigen::Vector2d over_floor = shown - v * c * kick - carried_front * forward - carried_side * right;
  LinearFlight linear;
  linear.speed_mps = v;
  linear.cosine = c;
  linear.sine = s;
  linear.residual << over_floor.dot(kick), over_floor.dot(left),
      flight.speed_mps * std::sin(flight.elevation_rad) - v * s,
      flight.late_s ? *flight.late_s - offsets[kDelayPart] : 0.0;
  linear.design.col(kSpeedPart) << v * c, 0.0, v * s, 0.0;
  linear.design.col(kElevationPart) << -v * s, 0.0, v * c, 0.0;
  linear.design.col(kDirectionPart) << 0.0, v * c, 0.0, 0.0;
  // What the ball takes along turns with the robot, too.
  const Eigen::Vector2d turned = omega * (carried_side * forward - carried_front * right);
  linear.design.col(kDelayPart) << turned.dot(kick), omega * v * c + turned.dot(left), 0.0, flight.late_s ? 1.0 : 0.0;
  linear.design.col(kAlongPart) << front_mps * forward.dot(kick), front_mps * forward.dot(left), 0.0, 0.0;
  linear.design.col(kSidewaysPart) << side_mps * right.dot(kick), side_mps * right.dot(left), 0.0, 0.0;
  return linear;
}

namespace {

constexpr std::size_t kMostBeliefs = 8;
constexpr double kWide = 0.05;              // weight of the belief that a file is worse than it says ...
constexpr double kWider = 3.0;              // ... by this factor; assumptions
constexpr double kMistaken = 0.02;          // how often the sightings say nothing of the kicker; assumption
constexpr double kMistakenSpeed_mps = 2.0;  // by how much they are off then
constexpr double kMistakenLate_s = 0.1;
constexpr double kForgotten = 0.03;       // from kick to kick it changes by this share of a day's change
constexpr double kRobotSpeed_mps = 0.05;  // of the robot's own velocity, each axis; assumption
constexpr double kHeading_rad = 0.014;    // of the robot's heading at the release; assumption
constexpr double kSeenLate_s = 0.01;      // of the release that a flight shows; assumption
constexpr double kTilt_rad = 0.005;       // a parabola's elevation varies so much with the flight's length
constexpr double kFileKicks = 40.0;       // kicks that the file's spreads count as ...
constexpr double kMostKicks = 100.0;      // ... and those of the learned ones, so that they can change
constexpr double kFarthest_sd = 3.0;      // a residual tells no more of the spread than this
constexpr double kLeastSpread = 0.5;      // of the file's
constexpr double kNotSeen_s = 10.0;       // standard deviation of a release that was not seen

using Matrix4 = Eigen::Matrix4d;

/// Covariance of what one flight shows, beside what is not known of the kicker.
Matrix4 noise_of(const KickFlight& flight, const LinearFlight& linear, const KickerEstimate& spread) {
  const double v = linear.speed_mps, c = linear.cosine, s = linear.sine;
  const double speed = v * spread.speed_sd_ratio, tilt = v * std::hypot(spread.elevation_sd_rad, kTilt_rad);
  const double turn =
      v * c * std::hypot(spread.direction_sd_rad, kHeading_rad, flight.twist.omega_radps * spread.delay_sd_s);
  const double seen = flight.sd_mps * flight.sd_mps, own = seen + kRobotSpeed_mps * kRobotSpeed_mps;
  const double late_s = flight.late_s ? std::hypot(spread.delay_sd_s, kSeenLate_s) : kNotSeen_s;
  Matrix4 noise = Matrix4::Zero();
  noise(0, 0) = speed * speed * c * c + tilt * tilt * s * s + own;
  noise(2, 2) = speed * speed * s * s + tilt * tilt * c * c + seen;
  noise(0, 2) = noise(2, 0) = (speed * speed - tilt * tilt) * s * c;
  noise(1, 1) = turn * turn + own;
  noise(3, 3) = late_s * late_s;
  return noise;
}

/// ln of the normal density, without its constant.
double log_density(double chi_square, const Matrix4& covariance) {
  return -0.5 * (chi_square + std::log(covariance.determinant()));
}

bool usable(const KickFlight& flight) {
  return flight.speed_mps > 0.0 && std::isfinite(flight.speed_mps + flight.elevation_rad + flight.direction_rad +
                                                 flight.sd_mps + flight.power + flight.release.heading_rad +
                                                 flight.twist.vx_mps + flight.twist.vy_mps + flight.twist.omega_radps);
}

double square(double x) { return x * x; }

}  // namespace

KickerLearner::KickerLearner(const RobotModel& file, const KickerChange& change) : file_(file), change_(change) {
  day_.diagonal() << square(change.speed_sd_ratio), square(change.elevation_sd_rad), square(change.direction_sd_rad),
      square(change.delay_sd_s), square(change.transfer_sd_ratio), square(change.transfer_sd_ratio);
  const KickSpreads& spreads = file.spreads;
  estimate_.speed_sd_ratio = spreads.speed_sd_ratio;
  estimate_.elevation_sd_rad = spreads.exit_angle_sd_rad;
  estimate_.direction_sd_rad = spreads.direction_sd_rad;
  estimate_.delay_sd_s = spreads.delay_sd_s;
  spread_weight_ = kFileKicks;
  KickerVector file_errors;
  file_errors << spreads.table_sd_ratio, spreads.exit_angle_se_rad, spreads.direction_se_rad, spreads.delay_se_s,
      spreads.transfer_sd_ratio, spreads.transfer_sd_ratio;
  begin(KickerVector::Zero(), file_errors);
}

/// A file may be worse than it says: a part of the belief is wide.
void KickerLearner::begin(const KickerVector& mean, const KickerVector& errors) {
  Belief near;
  near.mean = mean;
  near.covariance = day_;
  near.covariance.diagonal() += errors.cwiseAbs2();
  near.weight = 1.0 - kWide;
  Belief wide = near;
  wide.covariance *= square(kWider);
  wide.weight = kWide;
  beliefs_ = {near, wide};
  describe();
}

void KickerLearner::begin_with(const KickerEstimate& earlier) {
  estimate_ = earlier;
  estimate_.kicks = 0;
  estimate_.p_mistaken = estimate_.p_jump = estimate_.chi_square = 0.0;
  begin(earlier.mean, earlier.se);
}

/// Mean and covariance of the mixture, with the unconfirmed jump or without.
KickerLearner::Belief KickerLearner::all_in_one(bool unconfirmed) const {
  const auto weight = [&](const Belief& belief) { return unconfirmed || !belief.unconfirmed ? belief.weight : 0.0; };
  Belief all;
  double sum = 0.0;
  for (const Belief& belief : beliefs_) {
    sum += weight(belief);
    all.mean += weight(belief) * belief.mean;
  }
  constexpr double kNothing = 1e-9;  // no other belief explains the flights
  if (sum < kNothing && !unconfirmed) return all_in_one(true);
  all.mean /= sum;
  for (const Belief& belief : beliefs_) {
    const KickerVector off = belief.mean - all.mean;
    all.covariance += weight(belief) / sum * (belief.covariance + off * off.transpose());
  }
  return all;
}

/// A Kalman step, as far as the flight says something of the kicker.
void KickerLearner::move(Belief& belief, const KickFlight& flight) const {
  const LinearFlight linear = linear_flight(flight, file_, belief.mean);
  const auto& h = linear.design;
  const Matrix4 covariance = h * belief.covariance * h.transpose() + noise_of(flight, linear, estimate_);
  const Matrix4 inverse = covariance.inverse();
  Matrix4 wide = covariance;
  wide.diagonal().array() += Eigen::Array4d(square(kMistakenSpeed_mps), square(kMistakenSpeed_mps),
                                            square(kMistakenSpeed_mps), square(kMistakenLate_s));
  belief.chi_square = linear.residual.dot(inverse * linear.residual);
  const double right = std::log1p(-kMistaken) + log_density(belief.chi_square, covariance);
  const double wrong = std::log(kMistaken) + log_density(linear.residual.dot(wide.inverse() * linear.residual), wide);
  const double best = std::max(right, wrong);
  belief.log_likelihood = best + std::log(std::exp(right - best) + std::exp(wrong - best));
  const double says = std::exp(right - belief.log_likelihood);
  belief.says_something = says;

  const Eigen::Matrix<double, kKickerParts, 4> gain = belief.covariance * h.transpose() * inverse;
  const KickerVector by = gain * linear.residual;
  const KickerMatrix less = gain * h * belief.covariance;
  belief.mean += says * by;
  belief.covariance += says * (1.0 - says) * by * by.transpose() - 0.5 * says * (less + less.transpose());
}

/// Each spread moves towards what the residual shows beyond what else is not known.
void KickerLearner::learn_spreads(const Belief& before, const KickFlight& flight, double weight) {
  const LinearFlight linear = linear_flight(flight, file_, before.mean);
  const Matrix4 known = linear.design * before.covariance * linear.design.transpose();
  const double v = linear.speed_mps, c = linear.cosine, s = linear.sine;
  const double seen = square(flight.sd_mps), own = seen + square(kRobotSpeed_mps);
  spread_weight_ = std::min(spread_weight_ + weight, kMostKicks);
  const auto towards = [&](double& sd, double file_sd, double residual, double variance) {
    const double shown = square(std::min(std::abs(residual), kFarthest_sd * std::hypot(sd, std::sqrt(variance))));
    const double learned = sd * sd + weight / spread_weight_ * (shown - variance - sd * sd);
    sd = std::sqrt(std::max(square(kLeastSpread * file_sd), learned));
  };
  const KickSpreads& file = file_.spreads;
  const FlightResidual& r = linear.residual;
  towards(estimate_.speed_sd_ratio, file.speed_sd_ratio, (c * r[0] + s * r[2]) / v,
          (c * c * (known(0, 0) + own) + s * s * (known(2, 2) + seen) + 2.0 * s * c * known(0, 2)) / (v * v));
  towards(estimate_.elevation_sd_rad, file.exit_angle_sd_rad, (c * r[2] - s * r[0]) / v,
          (s * s * (known(0, 0) + own) + c * c * (known(2, 2) + seen) - 2.0 * s * c * known(0, 2)) / (v * v) +
              square(kTilt_rad));
  towards(estimate_.direction_sd_rad, file.direction_sd_rad, r[1] / (v * c),
          (known(1, 1) + own) / square(v * c) + square(kHeading_rad) +
              square(flight.twist.omega_radps * estimate_.delay_sd_s));
  if (flight.late_s) towards(estimate_.delay_sd_s, file.delay_sd_s, r[3], known(3, 3) + square(kSeenLate_s));
}

bool KickerLearner::learn(const KickFlight& flight) {
  if (!usable(flight)) return false;
  Belief jumped = all_in_one(true);
  jumped.weight = change_.jump_chance;
  jumped.unconfirmed = true;
  jumped.covariance += day_;
  for (Belief& belief : beliefs_) {
    belief.unconfirmed = false;
    belief.weight *= 1.0 - change_.jump_chance;
    belief.covariance += square(kForgotten) * day_;
  }
  beliefs_.push_back(jumped);
  const Belief before = beliefs_.front();
  double best = -HUGE_VAL, sum = 0.0;
  for (Belief& belief : beliefs_) {
    move(belief, flight);
    best = std::max(best, belief.log_likelihood);
  }
  for (Belief& belief : beliefs_) sum += belief.weight *= std::exp(belief.log_likelihood - best);
  double mistaken = 0.0;
  for (Belief& belief : beliefs_) {
    belief.weight /= sum;
    mistaken += belief.weight * (1.0 - belief.says_something);
  }
  estimate_.p_mistaken = mistaken;
  estimate_.p_jump = beliefs_.back().weight;
  estimate_.chi_square = beliefs_.front().chi_square;
  ++estimate_.kicks;
  learn_spreads(before, flight, beliefs_.front().weight * beliefs_.front().says_something);
  std::ranges::sort(beliefs_, std::ranges::greater{}, &Belief::weight);
  if (beliefs_.size() > kMostBeliefs) beliefs_.resize(kMostBeliefs);
  const double kept = std::accumulate(beliefs_.begin(), beliefs_.end(), 0.0,
                                      [](double weight, const Belief& belief) { return weight + belief.weight; });
  for (Belief& belief : beliefs_) belief.weight /= kept;
  describe();
  return true;
}

void KickerLearner::describe() {
  const Belief all = all_in_one(false);
  estimate_.mean = all.mean;
  estimate_.se = all.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace trivela::kicking
