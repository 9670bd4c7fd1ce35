#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace trivela::evaluator {

/// What counts as the outcome of a kick on target of which the rules of its session count no goal (view labelled_kicks,
/// log/schema/reading_views.sql), and when that is, in a sentence.
struct NoGoal {
  const char* label;
  const char* where;
};
inline constexpr std::array<NoGoal, 2> kNoGoals{
    {{"own_half", "from the own half"}, {"carried_too_far", "after the ball was carried too far"}}};

inline bool is_no_goal(std::string_view label) {
  return std::ranges::any_of(kNoGoals, [&](const NoGoal& rule) { return label == rule.label; });
}

}  // namespace trivela::evaluator
