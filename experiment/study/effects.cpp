#include "experiment/study/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluator/render/table.hpp"

namespace trivela::experiment {
namespace {

double real(std::int64_t n) { return static_cast<double>(n); }

/// What a measure counts.
struct Share {
  const char* name;
  std::int64_t MatchTally::*inside;
  std::int64_t MatchTally::*of;
};
constexpr std::array kShares{
    // in the order of Measure
    Share{"on target of kicks [%]", &MatchTally::on_target, &MatchTally::kicks},
    Share{"on target of kicks [%]", &MatchTally::on_target, &MatchTally::kicks},
    Share{"on target of 100 opportunities", &MatchTally::on_target, &MatchTally::opportunities},
    Share{"goals of 100 opportunities", &MatchTally::goals, &MatchTally::opportunities},
    Share{"bounced of those on target [%]", &MatchTally::bounced, &MatchTally::on_target},
    Share{"blocked of kicks [%]", &MatchTally::blocked, &MatchTally::kicks},
    Share{"kicks of 100 opportunities", &MatchTally::kicks, &MatchTally::opportunities}};

bool in_two_matches(const ArmTally& arm, Measure measure) {
  return std::ranges::count_if(arm, [&](const MatchTally& match) { return counts_of(match, measure).n > 0; }) >= 2;
}

/// Half the width of the 95 % interval of an estimate to whose error each match adds its `u`: Student's t times the
/// standard error (cluster_variance()). NaN: fewer than two matches.
double half_width_of(const ArmTally& arm, const std::vector<double>& u) {
  std::vector<evaluator::stats::Influence> influences;
  for (std::size_t m = 0; m < arm.size(); ++m)
    influences.push_back({static_cast<std::uint32_t>(m), arm[m].calibration, u[m]});
  const auto variance = evaluator::stats::cluster_variance(influences);
  return variance ? variance->reach() : std::nan("");
}

}  // namespace

bool has_interval(const Effect& effect) { return std::isfinite(effect.ci.lo) && std::isfinite(effect.ci.hi); }

MatchTally total_of(const ArmTally& matches) {
  MatchTally total;
  for (const MatchTally& match : matches)
    for (const log::TallyField& count : log::kTallyFields) total.*count.field += match.*count.field;
  return total;
}

const char* name_of(Measure measure) { return kShares[static_cast<std::size_t>(measure)].name; }

evaluator::stats::Counts counts_of(const MatchTally& tally, Measure measure) {
  const Share& share = kShares[static_cast<std::size_t>(measure)];
  return {tally.*share.inside, tally.*share.of - (measure == Measure::kUnblocked ? tally.blocked : 0)};
}

Effect contrast(const std::vector<Term>& terms, Measure measure) {
  Effect effect;
  std::vector<double> influences;
  bool in_matches = true, varies = false;
  for (const Term& term : terms) {
    in_matches = in_matches && in_two_matches(*term.arm, measure);
    const auto total = counts_of(total_of(*term.arm), measure);
    const double n = real(total.n), p = real(total.inside) / n;
    effect.value += term.weight * p;
    varies = varies || (p > 0.0 && p < 1.0);
    influences.resize(term.arm->size());
    for (std::size_t m = 0; m < term.arm->size(); ++m) {
      const auto match = counts_of((*term.arm)[m], measure);
      influences[m] += term.weight * (real(match.inside) - p * real(match.n)) / n;
    }
  }
  const double reach = in_matches && varies ? half_width_of(*terms.front().arm, influences) : std::nan("");
  effect.ci = {effect.value - reach, effect.value + reach};
  return effect;
}

Effect difference(const ArmTally& newer, const ArmTally& older, Measure measure) {
  return contrast({{&newer, 1.0}, {&older, -1.0}}, measure);
}

Effect share_of(const ArmTally& matches, Measure measure) {
  const auto total = counts_of(total_of(matches), measure);
  const double none = std::nan("");
  Effect share{real(total.inside) / real(total.n), {none, none}};
  if (!in_two_matches(matches, measure)) return share;
  std::vector<evaluator::stats::ClusterCounts> cells;
  for (const MatchTally& match : matches)
    cells.push_back({static_cast<std::uint32_t>(cells.size()), match.calibration, counts_of(match, measure)});
  share.ci = evaluator::stats::clustered_wilson(cells).value_or(evaluator::stats::wilson_or_exact(total));
  return share;
}

Effect kick_ratio(const ArmTally& older, const ArmTally& newer) {
  const double n1 = real(total_of(older).kicks), n2 = real(total_of(newer).kicks);
  const bool in_matches = in_two_matches(older, Measure::kEfficiency) && in_two_matches(newer, Measure::kEfficiency);
  const double ratio = n1 == 0.0 ? std::nan("") : n2 / n1;
  std::vector<double> influences(older.size());
  for (std::size_t m = 0; m < older.size(); ++m) influences[m] = real(newer[m].kicks) / n2 - real(older[m].kicks) / n1;
  const double reach = in_matches ? half_width_of(older, influences) : std::nan("");
  return {ratio, {ratio * std::exp(-reach), ratio * std::exp(reach)}};
}

Effect jackknife(const std::vector<const ArmTally*>& arms,
                 const std::function<double(const std::vector<MatchTally>&)>& of) {
  std::vector<MatchTally> totals;
  totals.reserve(arms.size());
  for (const ArmTally* arm : arms) totals.push_back(total_of(*arm));
  const double value = of(totals);
  const ArmTally& matches = *arms.front();
  const auto without_match = [&](std::size_t m) {
    std::vector<MatchTally> rest = totals;
    for (std::size_t a = 0; a < arms.size(); ++a)
      for (const log::TallyField& count : log::kTallyFields) rest[a].*count.field -= (*arms[a])[m].*count.field;
    return of(rest);
  };
  const double reach = half_width_of(matches, evaluator::stats::jackknife(matches.size(), without_match));
  return {value, {value - reach, value + reach}};
}

std::string share_text(const Effect& effect) { return evaluator::text_of(json_of(effect), {"", "", "{:.1f}", 100.0}); }

std::string points_text(const Effect& effect) {
  return evaluator::text_of(json_of(effect), {"", "", "{:+.1f}", 100.0});
}

Json json_of(const Effect& effect) {
  if (!std::isfinite(effect.value)) return nullptr;
  return {{"value", effect.value}, {"ci", has_interval(effect) ? evaluator::json_of(effect.ci) : Json()}};
}

std::string label_warning(const std::string& arm, const ArmTally& observed) {
  if (total_of(observed).kicks == 0) return {};
  ArmTally truth = observed;
  for (MatchTally& match : truth) match.on_target = match.true_on_target;
  const Effect said = share_of(observed, Measure::kPerOpportunity), is = share_of(truth, Measure::kPerOpportunity);
  if (!has_interval(said) || (is.value >= said.ci.lo && is.value <= said.ci.hi)) return {};
  return fmt::format(
      "{}: many labels are wrong or unknown: {:.4f} ({:.4f} to {:.4f}) on target an opportunity by the observer, "
      "{:.4f} "
      "by the simulator's truth\n",
      arm, said.value, said.ci.lo, said.ci.hi, is.value);
}

}  // namespace trivela::experiment
