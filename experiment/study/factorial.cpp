#include "experiment/study/factorial.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::experiment {
namespace {

using kicking::PolicyName;

constexpr std::array kLaws{Law::kPaper, Law::kReleased, Law::kExact};

const ArmTally& matches_of(const std::vector<PlayedCell>& cells, const Cell& wanted) {
  const auto found =
      std::ranges::find(cells, wanted.name(), [](const PlayedCell& played) { return played.cell.name(); });
  if (found == cells.end()) throw std::invalid_argument("factorial: no cell " + wanted.name());
  return found->matches;
}

using Weight = std::function<double(const Cell&)>;

std::vector<Term> terms_of(const std::vector<PlayedCell>& cells, const Weight& weight) {
  std::vector<Term> terms;
  for (const Cell& cell : factorial_cells()) {
    if (const double w = weight(cell); w != 0.0) terms.push_back({&matches_of(cells, cell), w});
  }
  return terms;
}

double table_sign(const Cell& cell) { return cell.table == "new" ? 1.0 : -1.0; }

/// +1 moving, -1 stopped, 0 predictive.
double motion_sign(const Cell& cell) {
  if (cell.policy == PolicyName::kPredictive) return 0.0;
  return cell.policy == PolicyName::kMoving ? 1.0 : -1.0;
}

/// +1 the law, -1 the paper's, 0 other laws and predictive.
double law_sign(const Cell& cell, Law law) {
  if (cell.policy == PolicyName::kPredictive) return 0.0;
  return cell.law == law ? 1.0 : cell.law == Law::kPaper ? -1.0 : 0.0;
}

/// +1 predictive, -1 moving with the exact law, 0 the others.
double prediction_sign(const Cell& cell) {
  if (cell.policy == PolicyName::kPredictive) return 1.0;
  return cell.policy == PolicyName::kMoving && cell.law == Law::kExact ? -1.0 : 0.0;
}

/// Where `y` first meets `level`, linear between the points; none: nowhere.
std::optional<double> meets(const std::vector<SweepPoint>& sweep, double level,
                            const std::function<double(const SweepPoint&)>& y) {
  for (std::size_t i = 1; i < sweep.size(); ++i) {
    const double before = y(sweep[i - 1]) - level, after = y(sweep[i]) - level;
    if (!(before * after <= 0.0) || before == after) continue;
    return std::lerp(sweep[i - 1].value_m, sweep[i].value_m, before / (before - after));
  }
  return std::nullopt;
}

double efficiency_of(const ArmTally& matches, Measure efficiency) {
  const auto counts = counts_of(total_of(matches), efficiency);
  return static_cast<double>(counts.inside) / static_cast<double>(counts.n);
}

}  // namespace

const char* name(Law law) {
  switch (law) {
    case Law::kPaper:
      return "paper";
    case Law::kReleased:
      return "released";
    case Law::kExact:
      break;
  }
  return "exact";
}

std::string Cell::name() const {
  const std::string words = fmt::format("{} {}", table, kicking::name(policy));
  return policy == PolicyName::kPredictive ? words : fmt::format("{} {}", words, experiment::name(law));
}

std::vector<Cell> factorial_cells() {
  std::vector<Cell> cells;
  for (const char* table : {"old", "new"}) {
    for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving}) {
      for (const Law law : {Law::kPaper, Law::kReleased, Law::kExact}) cells.push_back({table, policy, law});
    }
    cells.push_back({table, PolicyName::kPredictive, Law::kExact});
  }
  return cells;
}

Arm arm_of(const Cell& cell, const config::Settings& settings, const std::vector<config::Robot>& robots) {
  Arm arm{.name = cell.name(),
          .policy = cell.policy,
          .table = cell.table,
          .settings = settings,
          .robots = robots,
          .random = {}};
  kicking::PolicyConfig& policy = arm.settings.policy;
  policy.motion_law = cell.law == Law::kExact ? kicking::MotionLaw::kExact : kicking::MotionLaw::kPaper;
  policy.height_law = cell.law == Law::kPaper      ? kicking::HeightLaw::kPaper
                      : cell.law == Law::kReleased ? kicking::HeightLaw::kExtendedRange
                                                   : kicking::HeightLaw::kExact;
  policy.alpha_law = kicking::AlphaLaw::kPaperLine;
  return arm;
}

bool both_within_papers(const SweepPoint& point, Measure efficiency) {
  const auto within = [&](const ArmTally& matches, evaluator::stats::Counts paper) {
    const auto ci = evaluator::stats::wilson(paper);
    const double value = efficiency_of(matches, efficiency);
    return value >= ci.lo && value <= ci.hi;
  };
  return within(point.older, kPaperOlder) && within(point.newer, kPaperNewer);
}

std::vector<NamedEffect> effects_of(const std::vector<PlayedCell>& cells, Measure efficiency) {
  std::vector<NamedEffect> effects;
  const auto add = [&](const char* key, const char* what, const Weight& weight) {
    const auto terms = terms_of(cells, weight);
    effects.push_back({key, what, contrast(terms, efficiency), contrast(terms, Measure::kPerOpportunity)});
  };
  const auto of_motion_cells = [](const Cell& cell) { return std::abs(motion_sign(cell)); };
  add("calibration", "new - old table, over stopped, moving and laws",
      [&](const Cell& cell) { return table_sign(cell) * of_motion_cells(cell) / 6.0; });
  add("motion", "moving - stopped, over tables and laws", [](const Cell& cell) { return motion_sign(cell) / 6.0; });
  add("released_law", "released - paper law, over tables, stopped and moving",
      [](const Cell& cell) { return law_sign(cell, Law::kReleased) / 4.0; });
  add("exact_law", "exact - paper law, over tables, stopped and moving",
      [](const Cell& cell) { return law_sign(cell, Law::kExact) / 4.0; });
  add("calibration_x_motion", "motion with the new table - motion with the old one, over laws",
      [](const Cell& cell) { return table_sign(cell) * motion_sign(cell) / 3.0; });
  add("exact_law_x_motion", "motion with the exact law - motion with the paper's, over tables",
      [](const Cell& cell) { return law_sign(cell, Law::kExact) * motion_sign(cell) / 2.0; });
  add("prediction", "predictive - moving with the exact law, over tables",
      [](const Cell& cell) { return prediction_sign(cell) / 2.0; });
  add("calibration_x_prediction", "prediction with the new table - prediction with the old one",
      [](const Cell& cell) { return table_sign(cell) * prediction_sign(cell); });
  return effects;
}

Gain gain_of(const std::vector<PlayedCell>& cells, Measure measure) {
  const auto sum = [&](const Weight& weight) { return contrast(terms_of(cells, weight), measure); };
  const auto laws = static_cast<double>(kLaws.size());
  return {.gain = sum(
              [&](const Cell& cell) { return table_sign(cell) == motion_sign(cell) ? table_sign(cell) / laws : 0.0; }),
          .calibration =
              sum([&](const Cell& cell) { return table_sign(cell) * std::abs(motion_sign(cell)) / (2.0 * laws); }),
          .motion = sum([&](const Cell& cell) { return motion_sign(cell) / (2.0 * laws); })};
}

SweepAnswer answer_of(const std::vector<SweepPoint>& sweep, Measure efficiency) {
  if (sweep.empty()) throw std::invalid_argument("factorial: the sweep has no point");
  SweepAnswer answer;
  const auto ratio = [](const SweepPoint& point) { return kick_ratio(point.older, point.newer); };
  answer.ratio_at_m = meets(sweep, kPaperKickRatio, [&](const SweepPoint& point) { return ratio(point).value; });
  answer.ratio_from_m = meets(sweep, kPaperKickRatio, [&](const SweepPoint& point) { return ratio(point).ci.lo; });
  answer.ratio_to_m = meets(sweep, kPaperKickRatio, [&](const SweepPoint& point) { return ratio(point).ci.hi; });
  if (answer.ratio_from_m && answer.ratio_to_m && *answer.ratio_from_m > *answer.ratio_to_m) {
    std::swap(answer.ratio_from_m, answer.ratio_to_m);
  }
  const double older = *evaluator::stats::efficiency(kPaperOlder), newer = *evaluator::stats::efficiency(kPaperNewer);
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const double e1 = efficiency_of(sweep[i].older, efficiency), e2 = efficiency_of(sweep[i].newer, efficiency);
    if (both_within_papers(sweep[i], efficiency)) answer.pair_within.push_back(i);
    const double off = std::hypot(e1 - older, e2 - newer);
    if (!(off < least)) continue;
    least = off;
    answer.nearest = i;
    answer.off_older = e1 - older;
    answer.off_newer = e2 - newer;
  }
  return answer;
}

}  // namespace trivela::experiment
