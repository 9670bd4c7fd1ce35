#include "evaluator/report/comparison.hpp"

#include <cassert>

#include "evaluator/stats/bayes.hpp"
#include "evaluator/stats/exact.hpp"

namespace trivela::evaluator {

bool Comparison::is_table2() const {
  return older.counts.inside == 34 && older.counts.n == 65 && newer.counts.inside == 100 && newer.counts.n == 132;
}

Comparison compare(const NamedCounts& older, const NamedCounts& newer) {
  assert(older.counts.n > 0 && newer.counts.n > 0);
  const auto& k1 = older.counts;
  const auto& k2 = newer.counts;
  return {.older = older,
          .newer = newer,
          .difference = *stats::efficiency(k2) - *stats::efficiency(k1),
          .newcombe95 = stats::newcombe(k1, k2),
          .relative_gain = stats::relative_gain(k1, k2),
          .risk_ratio = stats::risk_ratio(k1, k2),
          .odds_ratio = stats::odds_ratio(k1, k2),
          .fisher_one_sided_p = stats::fisher_one_sided(k1, k2),
          .fisher_two_sided_p = stats::fisher_two_sided(k1, k2),
          .boschloo_one_sided_p = stats::boschloo_one_sided(k1, k2),
          .boschloo_two_sided_p = stats::boschloo_two_sided_doubled(k1, k2),
          .p_new_better = stats::p_new_better(k1, k2)};
}

std::vector<std::string> notes(const Comparison& comparison) {
  std::vector<std::string> notes = {
      "Intervals and tests take every kick as independent; kicks of one match share floor, opponent and calibration, "
      "so the truth is less certain."};
  if (!comparison.is_table2()) return notes;
  const std::vector<std::string> paper = {
      "The paper writes that \"an average of 52% of the kicks would never translate into valid direct goals\": the "
      "wrong way round, 52.3 % went inside; 31 of 65 = 47.7 % went out.",
      "Its \"efficiency improvement of 46%\" comes from the rounded 52 % and 76 %; the counts give 44.8 %, relative. "
      "In percentage points the gain is 23.4.",
      "Its \"overall efficiency\" from 50 % to 83 % and \"increase of over 60%\" is supported by no count, definition "
      "or table: Table 2 has 52.3 % and 75.8 % for the same two tournaments.",
      "Its \"negligible\" difference in kicks out of the goal is 31 against 32 kicks, but 47.7 % against 24.2 % of "
      "them.",
      "Its number of kicks that is \"much higher\" (132 against 65) is no rate: matches and minutes played are not "
      "given.",
      "\"Proving\" is too strong, and nothing is said of the matches' results: before and after are two tournaments "
      "with other opponents and floors, and the calibration of the height changed at the same time as the policy.",
      "\"In goal\" means between the posts and below the bar, saves included; it is not goals scored."};
  notes.insert(notes.end(), paper.begin(), paper.end());
  return notes;
}

}  // namespace trivela::evaluator
