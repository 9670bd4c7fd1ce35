#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/geometry/frames.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::evaluator {

/// A kick as its robot predicted and saw it; nothing here is a simulator's truth.
struct WatchedKick {
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;  ///< of the decision
  kicking::Pose robot{};  ///< at the decision, in F
  kicking::Twist twist{};
  double lead_s = 0.0;                            ///< from the decision to the expected release
  int policy = 0;                                 ///< that kicked: each predicts with an error of its own
  double goal_y_m = 0.0;                          ///< where it crosses
  double x_m = 0.0, z_m = 0.0, t_flight_s = 0.0;  ///< predicted crossing and flight
  bool seen_to_the_line = false;                  ///< not blocked, outcome known
  bool bounced = false;                           ///< it touched the floor before the line
  kicking::OptionalDouble z_cross_m{};            ///< observed
  kicking::OptionalDouble exit_speed_mps{};       ///< observed, of the ball over ground
};

/// By how much a kick was stronger than predicted, measured twice: 0.03 is 3 % more speed out of the kicker. It is ln f
/// of the factor f by which the kicker's part of the ball's velocity would explain what was seen.
struct KickResidual {
  std::optional<double> height;  ///< out of where it crossed: (z - z predicted) / (dz / d ln f)
  bool height_at_most = false;   ///< it bounced: free flight would have been at the floor or below
  std::optional<double> speed;   ///< out of its exit speed: ln(v / v predicted) / (d ln v / d ln f)
  int group = 0;                 ///< kicks whose predictions have one error in common: the policy
  double metres = 0.0;           ///< dz / d ln f, m: height that a residual of 1 is
};

/// The residuals of a kick; empty where it has no such prediction, or was not seen to the line. The predicted velocity
/// at the release is that of the drag-free flight from where the robot is then to the predicted crossing; the robot's
/// own motion at the ball's place (v + omega x r) is not the kicker's and does not scale with f:
///   dz / d ln f = v_z t (1 - q) + g t^2 q,  q = k . e / |e|^2,  k = e - (v + omega x r),
/// with e the horizontal velocity and t the time of flight.
KickResidual residual_of(const WatchedKick& kick);

/// How a chart judges.
struct ChartRule {
  double shift = 0.03;         ///< change of the mean that it is made for, either way
  double limit = 7.2;          ///< nats: it alarms above
  double expected_sd = 0.025;  ///< of one residual, before there are any; counts as so many residuals:
  double expected_weight = 10.0;
  int quiet = 20;     ///< first residuals of a group, which make its mean and are not judged
  double clip = 2.0;  ///< standard deviations: one residual counts as no farther off
};

/// A two-sided CUSUM (Page 1954) of residuals whose mean and spread are not known beforehand: each is judged by those
/// of its group before it, then joins them; the spread is that of all. An increment is the logarithm of the likelihood
/// ratio of a mean that has moved by `shift` to one that has not; with known parameters the mean run length without a
/// change is at least e^limit a side (Lorden 1971). Of a residual that is only known to be at most x the likelihood is
/// that of all below.
class FactorChart {
 public:
  explicit FactorChart(const ChartRule& rule) : rule_(rule) {}

  /// True: it has left its limit.
  bool add(double x, bool at_most, int group = 0);

  double up() const { return up_; }
  double down() const { return down_; }
  double sd() const;

 private:
  struct Group {
    std::size_t count = 0;
    double mean = 0.0;
  };
  void judge(const Group& group, double x, bool at_most);

  ChartRule rule_;
  std::map<int, Group> groups_;
  std::size_t known_ = 0;  // residuals beyond the first of each group
  double squares_ = 0.0;   // sum of squares about the groups' means
  double up_ = 0.0, down_ = 0.0;
};

/// Mean of a normal variable given that it is at most `c` [standard deviations about its mean], in those: -phi / Phi.
double mean_below(double c);

/// The two charts of a robot. Limits are chosen by run lengths that were measured (docs/drift.md).
struct DriftRule {
  ChartRule height{};
  ChartRule speed{.limit = 8.0, .expected_sd = 0.05};
};

enum class DriftKind {
  kExitSpeed,  ///< speed and height have changed as one factor explains
  kElevation   ///< the height has changed, the exit speed as good as not
};

/// An estimate and its standard error.
struct Shift {
  double value = 0.0;
  double se = 0.0;
};

/// A kicker that is not what it was.
struct Drift {
  DriftKind kind = DriftKind::kExitSpeed;
  std::size_t changed = 0;  ///< place of the first kick after the change, from 0
  std::size_t found = 0;    ///< of the kick that made it certain
  Shift factor{};  ///< ln of the exit speed after it by that before, out of the chart that alarmed, drawn towards 0
  std::optional<Shift> speed{};  ///< the same out of exit speeds alone
  double height_m = 0.0;         ///< what `factor` changes in the crossing height, on average of the kicks after it
};

/// The residuals against the prediction, as long as the kicker stays what it is.
struct DriftLevel {
  std::size_t from = 0;  ///< place of the kick that it begins with
  std::size_t heights = 0, speeds = 0;
  Shift height{}, speed{};  ///< means
};

struct DriftEstimate {
  std::vector<Drift> drifts;
  DriftLevel level;  ///< since the last of them
};

/// What the kicks of one robot, in their order, say of its kicker. After a change the charts begin again with the kicks
/// after it. The same kicks, and any before whose record is the same, give the same drifts: a kick more adds some at
/// the end and changes none.
DriftEstimate drifts_of(std::span<const KickResidual> kicks, const DriftRule& rule = {});

/// What to do, as a sentence for people: by what to multiply the table's speeds, what to measure again.
std::string correction_of(const Drift& drift);

/// The change in words: "exit speed fell by 3.1 % (standard error 0.8)".
std::string words_of(const Drift& drift);

}  // namespace trivela::evaluator
