#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/drift/factor_chart.hpp"
#include "evaluator/drift/kick_residual.hpp"

namespace trivela::evaluator {

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
/// after it. The same kicks, and any before whose story is the same, give the same drifts: a kick more adds some at the
/// end and changes none.
DriftEstimate drifts_of(std::span<const KickResidual> kicks, const DriftRule& rule = {});

/// What to do, as a sentence for people: by what to multiply the table's speeds, what to measure again.
std::string correction_of(const Drift& drift);

/// The change in words: "exit speed fell by 3.1 % (standard error 0.8)".
std::string words_of(const Drift& drift);

}  // namespace trivela::evaluator
