#pragma once

#include <array>
#include <string>

#include "evaluator/render/svg_chart.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

namespace trivela::evaluator::page {

/// Outcomes that figures tell apart, each by colour and by shape.
enum class OutcomeKind : std::size_t { kInside, kSaved, kFrame, kBeside, kBlocked, kUnknown };

struct OutcomeName {
  const char* key;    ///< class of its marks
  const char* words;  ///< in legends
};
inline constexpr std::array<OutcomeName, 6> kOutcomeNames{{{"inside", "on target"},
                                                           {"saved", "saved"},
                                                           {"frame", "post or bar"},
                                                           {"beside", "wide, over, short"},
                                                           {"blocked", "blocked"},
                                                           {"unknown", "not known"}}};

/// Of a kick's label; without one it is not known. "outside" and what is no goal by the rules are beside.
OutcomeKind kind_of(const KickTimeline& timeline);

/// Its mark: a dot, a bar, a square, a diamond, a cross or a ring.
std::string outcome_mark(OutcomeKind kind, const ChartPoint& at, double size);

/// How many kicks there are of each.
using OutcomeCounts = std::array<std::size_t, kOutcomeNames.size()>;

/// Two lines of samples with how many there are of each, from `y`; saves where there are some. Returns the SVG.
std::string outcome_legend(const OutcomeCounts& counts, double y);

/// "wide left" of "wide_left", "goal" or "saved" of one on target where that is known; "no outcome" where none came.
std::string outcome_words(const KickTimeline& timeline);

/// "kick 1:7, moving, 5.2 m, post": for who points at a mark.
std::string kick_words(const KickTimeline& timeline);

}  // namespace trivela::evaluator::page
