#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/play/arm.hpp"
#include "experiment/study/effects.hpp"
#include "kicking/policy/policy_config.hpp"

namespace trivela::experiment {

/// Height and motion law together, from the paper's words to the exact ones. Directions go by the paper's lines in all.
enum class Law {
  kPaper,     ///< range law, V_kick = V0 - k v cos(theta): the paper as printed
  kReleased,  ///< extended range, the same V_kick: the released code
  kExact      ///< crossing of the target, velocities added at the release
};

const char* name(Law law);

/// One cell of the factorial.
struct Cell {
  std::string table;  ///< "old" or "new"
  kicking::PolicyName policy{};
  Law law = Law::kExact;

  /// "old stopped paper"; "new predictive", which predicts and has no law.
  std::string name() const;
};

/// {old, new} x ({stopped, moving} x law, predictive): 14 cells.
std::vector<Cell> factorial_cells();

/// The cell as an arm. `settings` and `robots` are what all cells share; an old table is drawn for each match.
Arm arm_of(const Cell& cell, const config::Settings& settings, const std::vector<config::Robot>& robots);

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

/// The paper's two tournaments under one assumption. Older: old table and `stopped`; newer: new table and `moving`.
/// `value_m` is the opponents' median distance [m], or the common error of the person who made the old table: balls so
/// much over the target's height seemed to pass at it, at every distance and in every match [m].
struct SweepPoint {
  double value_m = 0.0;
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

/// Both arms lie in the 95 % Wilson intervals of what the paper counted.
bool both_within_papers(const SweepPoint& point, Measure efficiency);

}  // namespace trivela::experiment
