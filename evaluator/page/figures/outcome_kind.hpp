#pragma once

#include <array>
#include <optional>
#include <string>

#include "evaluator/render/svg_chart.hpp"
#include "evaluator/story/kick_timeline.hpp"

namespace trivela::evaluator::page {

/// Outcomes that figures tell apart, each by colour and by shape.
enum class OutcomeKind : std::size_t { kInside, kFrame, kBeside, kBlocked, kUnknown };

struct OutcomeName {
  const char* key;    ///< class of its marks
  const char* words;  ///< in legends
};
inline constexpr std::array<OutcomeName, 5> kOutcomeNames{{{"inside", "on target"},
                                                           {"frame", "post or bar"},
                                                           {"beside", "wide, over, short"},
                                                           {"blocked", "blocked"},
                                                           {"unknown", "not known"}}};

/// Of a kick's label; without one it is not known. "outside" and what is no goal by the rules are beside.
OutcomeKind kind_of(const KickTimeline& story);

/// Its mark: a dot, a square, a diamond, a cross or a ring.
std::string outcome_mark(OutcomeKind kind, const ChartPoint& at, double size);

/// A line of samples with how many there are of each, from `y`; returns the SVG.
std::string outcome_legend(const std::array<std::size_t, 5>& counts, double y);

/// "on target" of "on_target"; "no outcome" where none came.
std::string outcome_words(const KickTimeline& story);

/// "kick 1:7, moving, 5.2 m, post": for who points at a mark.
std::string kick_words(const KickTimeline& story);

}  // namespace trivela::evaluator::page
