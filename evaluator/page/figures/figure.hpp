#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evaluator/render/svg_chart.hpp"
#include "evaluator/timeline/kick_timeline.hpp"

namespace trivela::evaluator::page {

inline constexpr double kFigureWidth = 520.0;  ///< of every figure, in its own units; a telephone shows it at 0.7

/// What every figure of the page has.
struct FigureHead {
  std::string id;
  std::string says;  ///< for who hears the page
  double height = 0.0;
  bool simulated = false;
};

/// A figure: `marks` are SVG, the note beneath it plain text. Where the data are simulated it says so, in its lowest
/// line. Colours are the page's, so that it is light, dark or printed as the page is.
std::string figure(const FigureHead& head, const std::string& marks, const std::string& note);

/// A mark with words for who points at it: <g class="kind" ...><title>...</title>mark</g>.
std::string titled(const std::string& words, const std::string& mark, const std::string& attributes = "");

/// Grid, numbers and labels of two axes; x runs along the bottom.
std::string axes(const Axis& x, const Axis& y);

/// Class of the colour with a number: eight, then again.
std::string colour(std::size_t number);

/// A line of an interval plot: heading, or value with its interval.
struct IntervalRow {
  std::string label;
  bool heading = false;
  bool known = true;  ///< false: there is nothing to draw
  double value = 0.0, lo = 0.0, hi = 0.0;
  std::string numbers{};  ///< beside it
  std::size_t colour = 0;
};

/// Values with their intervals beneath each other (a forest plot), on one axis.
struct IntervalPlot {
  FigureHead head;  ///< the height follows from the rows
  std::string axis_label;
  double from = 0.0, to = 1.0;
  double unit = 1.0;  ///< a tick shows value / unit
  std::vector<IntervalRow> rows{};
  std::string note;
};
std::string interval_plot(IntervalPlot plot);

/// Counts of points in square cells, where there are too many points to draw.
class HeatMap {
 public:
  explicit HeatMap(double cell_m) : cell_m_(cell_m) {}

  void add(double x_m, double y_m);

  /// Cells as squares of class `kind`, the fuller the less transparent; y upwards by `y`.
  std::string draw(const std::string& kind, const Scale& x, const Scale& y) const;

  std::size_t fullest() const;

 private:
  double cell_m_;
  std::map<std::pair<long, long>, std::size_t> cells_;
};

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
