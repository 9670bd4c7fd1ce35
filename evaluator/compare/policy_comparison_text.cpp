#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string whole(std::int64_t n) { return std::to_string(n); }

std::string share(stats::Counts counts) {
  const auto p = stats::efficiency(counts);
  return p ? percent(*p) : "-";
}

bool is_few(stats::Counts counts) { return counts.n > 0 && counts.n < stats::kEnoughForWilson; }

std::string share_ci(stats::Counts counts, stats::Interval ci) { return counts.n > 0 ? percent(ci) : "-"; }

std::string groups_table(const PolicyComparison& c) {
  Rows table = {{c.by, "inside", "outside", "unknown", "efficiency", "95 %", "matches"}};
  for (const GroupResult& g : c.groups) {
    table.push_back({g.name, whole(g.inside()), whole(g.outside()), whole(g.unknown()), share(g.counts()),
                     share_ci(g.counts(), g.efficiency_ci),
                     g.matches > 0 ? whole(static_cast<std::int64_t>(g.matches)) : "-"});
  }
  if (c.dataset.blocked_apart) {
    table[0].push_back("blocked");
    for (std::size_t i = 0; i < c.groups.size(); ++i) table[i + 1].push_back(whole(c.groups[i].blocked()));
  }
  std::string text = "\nEfficiency\n" + text_table(table);
  if (c.dataset.blocked_apart) text += "  blocked kicks stand apart: neither outside nor in the efficiency\n";
  const bool few = std::ranges::any_of(c.groups, [](const GroupResult& g) { return is_few(g.counts()); });
  text += c.groups.front().by_match ? "  95 %: Wilson's, with kicks of one match taken as alike as they were\n"
          : few                     ? fmt::format(
                                          "  95 %: Wilson's, of fewer than {} kicks no narrower than Clopper and Pearson's; kicks taken as "
                                                              "independent\n",
                                          stats::kEnoughForWilson)
                : "  95 %: Wilson's, kicks taken as independent\n";
  return text;
}

std::string volume_table(const PolicyComparison& c) {
  bool minutes = false;
  for (const GroupResult& g : c.groups) minutes = minutes || g.played_min;
  if (!c.dataset.has_opportunities && !minutes) {
    return "\nVolume\n  neither opportunities nor minutes of play are known: how often each kicked cannot be said\n";
  }
  Rows table = {{c.by, "opportunities", "kicks", "kicks an opp.", "on target an opp.", "95 %", "minutes",
                 "kicks a min.", "on target a min."}};
  for (const GroupResult& g : c.groups) {
    const auto per_minute = [&](std::int64_t n) {
      const auto rate = g.per_min(n);
      return rate ? fmt::format("{:.3f}", *rate) : "-";
    };
    table.push_back({g.name, g.opportunities > 0 ? whole(g.opportunities) : "-", whole(g.kicks()),
                     g.opportunities > 0
                         ? fmt::format("{:.3f}", static_cast<double>(g.kicks()) / static_cast<double>(g.opportunities))
                         : "-",
                     share(g.per_opportunity()), share_ci(g.per_opportunity(), g.per_opportunity_ci),
                     g.played_min ? fmt::format("{:.1f}", *g.played_min) : "-", per_minute(g.kicks()),
                     per_minute(g.inside())});
  }
  return "\nVolume\n" + text_table(table);
}

const char* clusters(const stats::Clustered& clustered) {
  return clustered.by_calibration ? "clustered by match and calibration" : "clustered by match";
}

std::string calibrations(const stats::Clustered& clustered) {
  return clustered.calibrations > 1 ? fmt::format(", {} calibrations", clustered.calibrations) : "";
}

// What Table 2 does not tell of the balls inside: how many bounced, how many passed the keeper.
std::string inside_text(const PolicyComparison& c) {
  std::vector<NamedInside> groups;
  for (const GroupResult& g : c.groups) groups.push_back({g.name, g.inside_kicks});
  std::string text;
  for (const std::string& line : inside_lines(groups))
    text += fmt::format("{}  {}\n", text.empty() ? "\nOf the balls inside\n" : "", line);
  if (!c.dataset.keeper) return text;
  Rows table = {{c.by, "inside", "goals", "not known", "goals an opp.", "95 %"}};
  for (const GroupResult& g : c.groups) {
    const stats::Counts goals{g.goals(), g.opportunities};
    table.push_back({g.name, whole(g.inside()), whole(g.goals()), whole(g.goal_not_known()),
                     g.opportunities > 0 ? share(goals) : "-",
                     g.opportunities > 0 ? share_ci(goals, g.goals_ci) : "-"});
  }
  return text + fmt::format("\nGoals: inside and not saved, {}\n", c.dataset.outcome) + text_table(table);
}

std::string newcombe_of(const Effect& effect) {
  return is_few(effect.older) || is_few(effect.newer) ? "Newcombe, exact ends for few kicks" : "Newcombe";
}

std::string effect_lines(const std::string& name, const Effect& effect, const std::string& independent) {
  std::string text = named_line(
      name, fmt::format("{}, 95 % {} ({})", points(effect.difference), points(effect.independent), independent));
  if (effect.clustered) {
    text += named_line(
        "", fmt::format("95 % {} ({}: {} and {} matches{}, design effect {:.2f})", points(effect.clustered->ci),
                        clusters(*effect.clustered), effect.clustered->older_matches, effect.clustered->newer_matches,
                        calibrations(*effect.clustered), effect.clustered->design_effect));
  }
  return text;
}

std::string rate_line(const std::string& name, const std::optional<stats::RateRatio>& ratio) {
  if (!ratio) return "";
  return named_line(
      name, fmt::format("{:.3f} times, 95 % {:.3f} to {:.3f}, p {} ({})", ratio->value, ratio->ci.lo, ratio->ci.hi,
                        p_value(ratio->p), ratio->by_match ? "clustered by match" : "Poisson, exact"));
}

std::string strata_table(const PairResult& pair, const Stratified& s) {
  Rows table = {{s.column, pair.older, "", pair.newer, "", "difference"}};
  for (const StratumResult& row : s.strata) {
    const stats::Counts older = row.counts.older, newer = row.counts.newer;
    const bool both = older.n > 0 && newer.n > 0;
    table.push_back({row.name, fmt::format("{} of {}", older.inside, older.n), share(older),
                     fmt::format("{} of {}", newer.inside, newer.n), share(newer),
                     both ? fmt::format("{:+.1f}{}", 100.0 * (*stats::efficiency(newer) - *stats::efficiency(older)),
                                        row.reversed ? " (other sign)" : "")
                          : "-"});
  }
  std::string text =
      fmt::format("\nBy {} ({})\n", s.column, s.of_opportunities ? "inside of opportunities" : "inside of kicks") +
      text_table(table);
  if (s.left_out > 0) {
    text += fmt::format("  {} {} left out below: of situations that one side alone had, or unknown\n", s.left_out,
                        s.of_opportunities ? "opportunities" : "kicks");
  }
  return text;
}

std::string stratified_tests(const Stratified& s) {
  std::string text;
  if (s.odds_ratio) {
    text += named_line("common odds ratio",
                       fmt::format("{:.3f}, 95 % {:.3f} to {:.3f} (Mantel-Haenszel; Robins, Breslow, Greenland)",
                                   s.odds_ratio->value, s.odds_ratio->ci.lo, s.odds_ratio->ci.hi));
  }
  if (s.cmh && s.cmh_corrected) {
    text += named_line("no difference at all", fmt::format("p {} (Cochran-Mantel-Haenszel; {} with Yates' correction)",
                                                           p_value(s.cmh->p), p_value(s.cmh_corrected->p)));
  }
  if (s.risk_difference) {
    text +=
        named_line("common difference", fmt::format("{}, 95 % {} (Mantel-Haenszel; Sato)",
                                                    points(s.risk_difference->value), points(s.risk_difference->ci)));
  }
  if (s.homogeneity) {
    text += named_line(
        "same odds ratio",
        fmt::format("p {} (Breslow-Day){}", p_value(s.homogeneity->p),
                    s.homogeneity->p < 0.05 ? ": the policies differ more in some situations than in others" : ""));
  }
  return text;
}

std::string strata_text(const PairResult& pair, const Stratified& s) {
  std::string text = strata_table(pair, s);
  if (s.standardised) {
    text += named_line("standardised",
                       fmt::format("{} {}, {} {}: {}, 95 % {} (MOVER)", pair.older, percent(s.standardised->older),
                                   pair.newer, percent(s.standardised->newer), points(s.standardised->difference.value),
                                   points(s.standardised->difference.ci)));
  }
  if (s.clustered) text += named_line("", fmt::format("95 % {} ({})", points(s.clustered->ci), clusters(*s.clustered)));
  text += stratified_tests(s);
  if (s.simpson) {
    text +=
        bullet(fmt::format("Simpson's paradox: over all kicks one is better, on the same mix of {} the other; the mix "
                           "of situations makes the crude numbers.",
                           s.column));
  }
  return text;
}

std::string pairs_lines(const PairResult& pair) {
  if (!pair.pairs) return "";
  const auto& p = *pair.pairs;
  std::string text = named_line(
      "same opportunities", fmt::format("{}: on target both {}, {} alone {}, {} alone {}, neither {}", p.n(), p.both,
                                        pair.newer, p.newer_only, pair.older, p.older_only, p.neither));
  text += named_line("McNemar p", p_value(pair.mcnemar_p) + " (exact, two-sided)");
  if (pair.unpaired > 0)
    text += named_line("without partner", fmt::format("{} opportunities, left out", pair.unpaired));
  return text;
}

std::string kicks_text(const PairResult& pair) {
  if (!pair.kicks) return "";
  std::string text =
      fmt::format("\n{} against {}: efficiency, every kick taken as independent\n", pair.newer, pair.older);
  text += efficiency_lines(*pair.kicks);
  if (pair.design == Design::kBeforeAfter && pair.kicks->e_value && pair.kicks->e_value_ci) {
    text += named_line(
        "E-value",
        fmt::format("{:.2f} ({:.2f} for the interval): so strongly would something unrecorded have to go with both",
                    *pair.kicks->e_value, *pair.kicks->e_value_ci));
  }
  return text;
}

std::string doubts_text(const PairResult& pair, const PolicyComparison& c) {
  std::string text;
  if (pair.unknown > 0 || pair.expected_wrong > 0.0) {
    const std::string wrong = pair.expected_wrong > 0.0
                                  ? fmt::format(", and {:.1f} labels are expected to be wrong", pair.expected_wrong)
                                  : std::string();
    text +=
        bullet(fmt::format("{} unknown{}. If all of that went against {}, the crude difference {} would be {:+.1f} "
                           "points, if all for it {:+.1f}.",
                           pair.unknown == 1 ? "1 outcome is" : fmt::format("{} outcomes are", pair.unknown), wrong,
                           pair.newer, pair.headline->of_opportunities ? "an opportunity" : "in efficiency",
                           100.0 * pair.bounds.lo, 100.0 * pair.bounds.hi));
  }
  if (const auto& clustered = (pair.headline->of_opportunities ? pair.per_opportunity : pair.efficiency)->clustered;
      clustered && clustered->calibrations > 1 && !clustered->by_calibration) {
    text += bullet(fmt::format(
        "{} calibrations are too few to say how far calibrations differ: the intervals are for these {} alone.",
        clustered->calibrations, clustered->calibrations));
  }
  if (!pair.headline->by_match) {
    text += bullet(c.dataset.has_matches ? "Fewer than five matches a side: nothing can be said about how alike kicks "
                                           "of one match are, and the intervals take kicks as independent."
                                         : "Which kick belongs to which match is not known: the intervals take kicks "
                                           "as independent, so the truth is less certain.");
  }
  return text;
}

std::string pair_text(const PairResult& pair, const PolicyComparison& c) {
  std::string text = fmt::format("\n{} against {}\n", pair.newer, pair.older);
  if (!pair.headline) return text + bullet(pair.why_none + ".");
  if (pair.per_opportunity) {
    text += effect_lines("on target an opp.", *pair.per_opportunity,
                         pair.pairs ? "Newcombe's for pairs" : newcombe_of(*pair.per_opportunity));
  }
  if (pair.goals)
    text += effect_lines("goals an opp.", *pair.goals, pair.pairs ? "Newcombe's for pairs" : newcombe_of(*pair.goals));
  text += pairs_lines(pair);
  if (pair.efficiency)
    text += effect_lines("efficiency", *pair.efficiency, newcombe_of(*pair.efficiency) + ", kicks independent");
  text += rate_line("on target a minute", pair.on_target_rate);
  text += rate_line("kicks a minute", pair.kick_rate);
  if (pair.stratified) text += strata_text(pair, *pair.stratified);
  text += kicks_text(pair);
  text += doubts_text(pair, c);
  return text;
}

}  // namespace

std::string to_text(const PolicyComparison& c) {
  std::string text = head_text(c, SIZE_MAX);
  for (const PairResult& pair : c.pairs) {
    text += wrapped(verdict_sentence(pair, c), "  ") + "\n";
    const std::string more = needed_sentence(pair, c);
    if (!more.empty()) text += "  " + wrapped(more, "  ", 108) + "\n";
    if (c.pairs.size() > 1 && pair.headline) {
      text += fmt::format("  p {} after Holm's adjustment for {} comparisons\n", p_value(pair.headline->p_holm),
                          c.pairs.size());
    }
  }
  text += "\nDesign: " + wrapped(design_sentence(c.pairs.front(), c), "  ", 100) + ".\n";
  text += fmt::format("Outcomes: {}.\n", c.dataset.outcome == "truth"      ? "the simulator's truth"
                                         : c.dataset.outcome == "labelled" ? "as somebody labelled them"
                                         : c.dataset.outcome == "table"    ? "as the table says"
                                                                           : "as the robots observed them");
  if (c.sample_ratio_p) {
    text += fmt::format("Shares as planned: p {}{}\n", p_value(*c.sample_ratio_p),
                        *c.sample_ratio_p < 0.001
                            ? ". The assignment did not go as planned: trust nothing below before that is explained."
                            : "");
  }
  text += groups_table(c) + volume_table(c) + inside_text(c);
  for (const PairResult& pair : c.pairs) text += pair_text(pair, c);
  if (!c.dataset.remarks.empty()) text += "\nData\n";
  for (const std::string& remark : c.dataset.remarks) text += bullet(remark);
  text += "\n  inside: between the posts and below the bar, saves included; it is not goals scored\n";
  return text + gates_text(c.gates);
}

}  // namespace trivela::evaluator
