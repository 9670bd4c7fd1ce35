#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kicking/lob/scan.hpp"
#include "sim/laser/laser.hpp"
#include "sim/scenario.hpp"

namespace trivela::sim {

/// One kick of a synthetic record: true values, at the release.
struct SyntheticKick {
  double exit_speed_mps = 0.0;
  double exit_angle_rad = 0.0;  ///< over the floor
  double drag_coefficient = 0.25;
  std::optional<double> power;  ///< set-point that the operator would have entered
};

/// What happens in a synthetic record: nothing for `background_s`; then for each kick the ball is put on its place,
/// lies there for `lie_s`, is kicked, bounces, rolls, and is taken away `fly_s` after the kick; `pause_s` later the
/// next one is put there.
struct RecordPlan {
  std::vector<SyntheticKick> kicks;
  double background_s = 2.0;
  double lie_s = 0.6;
  double fly_s = 2.4;
  double pause_s = 0.5;
  double direction_error_rad = 0.0;  ///< of every kick from the scan plane, counter-clockwise
  double lateral_error_m = 0.0;      ///< of the ball's place from the scan plane, to its left
};

/// What was really kicked. For whoever judges an analysis, never for the analysis.
struct KickedTruth {
  std::int64_t launch_t_ns = 0;
  SyntheticKick kick;
};

struct SyntheticRecord {
  kicking::lob::LaserMount mount;
  std::vector<kicking::lob::Scan> scans;
  std::vector<KickedTruth> truth;
};

/// Scans of balls flown by advance(), kicked along the scan plane from F's origin, at z = r. Pure: the same arguments
/// give the same scans. Not a measurement: synthetic.
SyntheticRecord synthesize_record(const LaserModel& laser, const RecordPlan& plan, const BallPhysics& ball,
                                  std::uint64_t seed);

}  // namespace trivela::sim
