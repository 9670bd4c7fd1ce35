#pragma once

#include "kicking/policy/match_rules.hpp"
#include "kicking/policy/playing_field.hpp"
#include "kicking/range.hpp"

/// The keys of a field and of a match's rules, each named once with the range it may take; found by ADL.
namespace trivela::kicking {

template <class V>
void fields(V& v, MatchRules& r) {
  v("opponents_half_only", r.opponents_half_only);
  v("carry_limit_m", r.carry_limit_m, Range{0.0, 60.0});
  v("set_piece_s", r.set_piece_s, Range{0.0, 60.0});
}

template <class V>
void fields(V& v, PlayingField& f) {
  v("goal_line_y_m", f.goal_line_y_m, Range{1.0, 30.0});
  v("side_line_x_m", f.side_line_x_m, Range{1.0, 30.0});
  v("goal_half_width_m", f.goal_half_width_m, Range{0.3, 5.0});
  v("goal_height_m", f.goal_height_m, Range{0.3, 5.0});
  v("frame_thickness_m", f.frame_thickness_m, Range{0.0, 0.5});
}

}  // namespace trivela::kicking
