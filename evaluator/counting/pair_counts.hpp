#pragma once

#include <cstdint>
#include <vector>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/paired.hpp"

namespace trivela::evaluator {

/// Adds an ending: a trial, and a success if it was inside.
inline void add(stats::Counts& sum, Ending ending) {
  sum.inside += ending == Ending::kInside ? 1 : 0;
  sum.n += 1;
}
inline void add(stats::Counts& sum, stats::Counts counts) {
  sum.inside += counts.inside;
  sum.n += counts.n;
}

/// Counts of two groups by match, calibration and stratum, of opportunities or of kicks. A kick with an unknown outcome
/// is an opportunity without a shot on target, and left out of the kicks.
std::vector<stats::MatchCounts> cells_of(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer,
                                         bool of_opportunities);

/// Opportunities that two groups both had: of the same match, calibration, id and setting, which a group has once.
struct PairedOpportunities {
  stats::PairedCounts counts;
  std::vector<stats::MatchCounts> cells;  ///< the same by match and calibration
  std::int64_t unpaired = 0;              ///< without a partner
};
PairedOpportunities paired_opportunities(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer);

}  // namespace trivela::evaluator
