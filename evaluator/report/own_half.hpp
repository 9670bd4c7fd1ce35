#pragma once

namespace trivela::evaluator {

/// What counts as the outcome of a kick on target from where the rules of its session count no goal (view
/// labelled_kicks, evaluator/log/reading_views.sql).
inline constexpr const char* kOwnHalf = "own_half";

}  // namespace trivela::evaluator
