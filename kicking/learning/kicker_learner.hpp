#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "kicking/geometry/frames.hpp"
#include "kicking/learning/kicker_estimate.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// A kick as its robot decided it and saw it fly; nothing here is a simulator's truth.
struct KickFlight {
  double power = 0.0;
  Pose release{};          ///< of the robot, when its file expects the release, in F
  Twist twist{};           ///< at the decision
  double speed_mps = 0.0;  ///< of the drag-free parabola through the flight where it leaves the floor
  double elevation_rad = 0.0;
  double direction_rad = 0.0;  ///< heading of the flight in F
  double sd_mps = 0.0;         ///< standard deviation of a component of that velocity
  OptionalDouble late_s;       ///< it left so much later than expected; none: not seen
};

/// What a flight shows against what a kicker with these differences gives: along the kick, to its left, up [m/s], late
/// [s].
using FlightResidual = Eigen::Vector4d;

/// A flight against a model, linear about `offsets`: shown = residual(offsets) + design (truth - offsets) + noise.
///
///     velocity = V e^s (c' f + s' up) + (k + along) v_front f0 + (k + side) v_side r0
///
/// f0 and r0 are the robot's forward and right axes at the release, which omega turns during the delay; f is f0 turned
/// by the direction. c' and s' are cosine and sine of the file's angle and the elevation together.
struct LinearFlight {
  FlightResidual residual = FlightResidual::Zero();
  Eigen::Matrix<double, 4, kKickerParts> design = Eigen::Matrix<double, 4, kKickerParts>::Zero();
  double speed_mps = 0.0;  ///< V e^s
  double cosine = 1.0;     ///< c'
  double sine = 0.0;       ///< s'
};
LinearFlight linear_flight(const KickFlight& flight, const RobotModel& file, const KickerVector& offsets);

/// Learns from kick to kick in what a kicker differs from its file.
///
/// - The belief is a mixture of normal distributions of the six differences. Each stands for an instant at which the
///   kicker may have jumped last (Adams and MacKay 2007, with the likeliest instants alone).
/// - Before the first kick it is N(0, file's error^2 + KickerChange^2); a small part is three times as wide.
/// - A kick moves each of them as a Kalman filter does. Its sightings may also say nothing of the kicker: somebody
///   touched the ball, or the track is wrong. The likelihood decides how probable that is.
/// - A jump at the last kick counts once the next kick confirms it: one touched ball may feign it.
/// - Between kicks it forgets slowly.
/// - The spreads are learned from what is left of the residuals; the file's count as many kicks.
/// - Nothing but flights moves it.
class KickerLearner {
 public:
  /// `file` must outlive the learner.
  KickerLearner(const RobotModel& file, const KickerChange& change);

  const KickerEstimate& estimate() const { return estimate_; }

  /// Takes in one flight; one that is not finite or has no speed changes nothing. True: the estimate is another one.
  bool learn(const KickFlight& flight);

  /// Begins with an earlier estimate of the same robot: its means and errors, to which a day's change is added, and its
  /// spreads.
  void begin_with(const KickerEstimate& earlier);

 private:
  struct Belief {
    KickerVector mean = KickerVector::Zero();
    KickerMatrix covariance = KickerMatrix::Zero();
    double weight = 1.0;
    bool unconfirmed = false;     // the kicker jumped at the last flight, which no other one confirms yet
    double log_likelihood = 0.0;  // of the last flight
    double chi_square = 0.0;      // of its residuals
    double says_something = 1.0;  // probability that the last flight says something of the kicker
  };

  void begin(const KickerVector& mean, const KickerVector& errors);
  void move(Belief& belief, const KickFlight& flight) const;
  void learn_spreads(const Belief& before, const KickFlight& flight, double weight);
  Belief all_in_one(bool unconfirmed) const;
  void describe();

  const RobotModel& file_;
  KickerChange change_;
  KickerMatrix day_ = KickerMatrix::Zero();  // covariance of a change
  std::vector<Belief> beliefs_;              // the likeliest first
  double spread_weight_ = 0.0;
  KickerEstimate estimate_;
};

}  // namespace trivela::kicking
