#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/effects/effects.hpp"
#include "experiment/factorial/design.hpp"

namespace trivela::experiment {

// What the paper observed: Table 2 (34 of 65 and 100 of 132 kicks on target).
inline constexpr evaluator::stats::Counts kPaperOlder{34, 65};
inline constexpr evaluator::stats::Counts kPaperNewer{100, 132};
inline constexpr double kPaperKickRatio = 132.0 / 65.0;

/// A cell with its matches.
struct PlayedCell {
  Cell cell;
  ArmTally matches;
};

/// A main effect or an interaction in both measures.
struct NamedEffect {
  std::string key;   ///< "calibration"
  std::string what;  ///< what is subtracted from what, averaged over what
  Effect efficiency;
  Effect per_opportunity;
};

/// The effects of a factorial that holds every cell of factorial_cells():
/// calibration (new - old table), motion (moving - stopped), released_law and exact_law (each - paper), each averaged
/// over all levels of the other two factors; calibration_x_motion, exact_law_x_motion; prediction (predictive - moving
/// with the exact law), averaged over tables, and calibration_x_prediction.
/// `efficiency`: kEfficiency or, with blocked kicks apart, kUnblocked.
/// Throws std::invalid_argument naming a cell that is missing.
std::vector<NamedEffect> effects_of(const std::vector<PlayedCell>& cells, Measure efficiency = Measure::kEfficiency);

/// From the old table and `stopped` to the new one and `moving`, averaged over the laws: calibration and motion, each
/// as the mean of both orders of introducing them, add up to it.
struct Gain {
  Effect gain;
  Effect calibration;
  Effect motion;
};
Gain gain_of(const std::vector<PlayedCell>& cells, Measure measure);

/// The paper's two tournaments at one distance of the opponents: old table and `stopped`, new table and `moving`.
struct SweepPoint {
  double opponent_median_m = 0.0;
  ArmTally older;
  ArmTally newer;
};

/// Where the sweep meets the paper's numbers.
struct SweepAnswer {
  std::optional<double> ratio_at_m;    ///< kick ratio 2.03, linear between points; none: nowhere in the sweep
  std::optional<double> ratio_from_m;  ///< from where on ...
  std::optional<double> ratio_to_m;    ///< ... to where the ratio's 95 % interval has it; none: beyond the sweep
  std::optional<std::size_t> nearest;  ///< point whose efficiencies are nearest to the paper's, both together; none:
                                       ///< at no point did both kick
  double off_older = 0.0;              ///< its efficiency - 34/65
  double off_newer = 0.0;              ///< its efficiency - 100/132
  std::vector<std::size_t>
      pair_within;  ///< points at which both lie in the 95 % Wilson intervals of the paper's counts
};

/// Throws std::invalid_argument for an empty sweep.
SweepAnswer answer_of(const std::vector<SweepPoint>& sweep, Measure efficiency = Measure::kEfficiency);

/// An arm lies in the 95 % Wilson interval of what the paper counted.
bool within_papers(const ArmTally& matches, Measure efficiency, evaluator::stats::Counts paper);

}  // namespace trivela::experiment
