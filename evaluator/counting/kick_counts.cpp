#include "evaluator/counting/kick_counts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace trivela::evaluator {
namespace {

void add_line(std::vector<std::string>& lines, std::span<const NamedInside> groups, const char* what,
              ReportsOfInside InsideKicks::*said, bool truth) {
  std::vector<std::string> parts;
  for (const NamedInside& group : groups) {
    const ReportsOfInside& of = group.inside.*said;
    if ((truth ? of.truth : of.observed) == 0) continue;
    parts.push_back(
        fmt::format("{} {} of {}", group.name, truth ? of.truth_yes : of.observed_yes, truth ? of.truth : of.observed));
  }
  if (parts.empty()) return;
  lines.push_back(fmt::format("{}, of those inside, {}: {}", what, truth ? "by the simulator's truth" : "as observed",
                              fmt::join(parts, ", ")));
}

Json share(std::int64_t yes, std::int64_t of, const char* what) {
  return of > 0 ? Json{{what, yes}, {"of", of}} : Json();
}

// As view labelled_kicks calls it.
const char* label_of(Ending ending) {
  return ending == Ending::kInside    ? "on_target"
         : ending == Ending::kOutside ? "outside"
         : ending == Ending::kBlocked ? "blocked"
                                      : "unknown";
}

}  // namespace

ReportsOfInside& ReportsOfInside::operator+=(const ReportsOfInside& other) {
  observed += other.observed;
  observed_yes += other.observed_yes;
  truth += other.truth;
  truth_yes += other.truth_yes;
  return *this;
}

void KickCounts::add(const std::string& label, const ReportsOfKick& said) {
  ++kicks_by_outcome[label];
  if (label != label_of(Ending::kInside)) return;
  inside_kicks.bounced.add(said.bounced, said.truth_bounced);
  inside_kicks.saved.add(said.saved, said.truth_saved);
  inside_kicks.by_people += said.by_people ? 1 : 0;
}

void KickCounts::add(const Opportunity& o) {
  if (o.ending == Ending::kNoKick) return;
  add(label_of(o.ending), o.said);
  doubt += {o.ending == Ending::kInside ? o.doubt : 0.0, o.ending == Ending::kOutside ? o.doubt : 0.0};
}

KickCounts& KickCounts::operator+=(const KickCounts& other) {
  const auto has_minutes = [](const KickCounts& of) { return of.played_min || of.kicks() == 0; };
  if (!has_minutes(*this) || !has_minutes(other)) {
    played_min.reset();
  } else if (other.played_min) {
    played_min = played_min.value_or(0.0) + *other.played_min;
  }
  for (const auto& [outcome, n] : other.kicks_by_outcome) kicks_by_outcome[outcome] += n;
  doubt += other.doubt;
  inside_kicks.bounced += other.inside_kicks.bounced;
  inside_kicks.saved += other.inside_kicks.saved;
  inside_kicks.by_people += other.inside_kicks.by_people;
  return *this;
}

std::int64_t KickCounts::kicks() const {
  std::int64_t sum = 0;
  for (const auto& [outcome, n] : kicks_by_outcome) sum += n;
  return sum;
}

std::int64_t KickCounts::of(const std::string& outcome) const {
  const auto found = kicks_by_outcome.find(outcome);
  return found == kicks_by_outcome.end() ? 0 : found->second;
}

std::int64_t KickCounts::saved() const {
  return by_truth ? inside_kicks.saved.truth_yes : inside_kicks.saved.observed_yes;
}

std::int64_t KickCounts::goal_not_known() const {
  return inside() - (by_truth ? inside_kicks.saved.truth : inside_kicks.saved.observed);
}

std::optional<double> KickCounts::per_min(std::int64_t n) const {
  if (!played_min || *played_min <= 0.0) return std::nullopt;
  return static_cast<double>(n) / *played_min;
}

std::vector<std::string> inside_lines(std::span<const NamedInside> groups) {
  const bool saves = std::ranges::any_of(groups, [](const NamedInside& group) { return group.inside.saved.any(); });
  std::vector<std::string> lines;
  for (const bool truth : {false, true})
    add_line(lines, groups, "bounced before the line", &InsideKicks::bounced, truth);
  for (const bool truth : {false, true})
    if (saves) add_line(lines, groups, "saved by a keeper", &InsideKicks::saved, truth);
  return lines;
}

Json said_json(const ReportsOfInside& said, const char* what) {
  return {{"observed", share(said.observed_yes, said.observed, what)},
          {"truth", share(said.truth_yes, said.truth, what)}};
}

namespace {

// match, calibration, id, setting
using PairKey = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::uint32_t>;

// Endings of a group in the order of their keys.
std::vector<std::pair<PairKey, Ending>> keyed(const KickDataset& dataset, std::uint32_t group) {
  std::vector<std::pair<PairKey, Ending>> rows;
  for (const Opportunity& o : dataset.opportunities) {
    if (o.group == group && o.id != 0) rows.push_back({{o.match, o.calibration, o.id, o.setting}, o.ending});
  }
  std::ranges::stable_sort(rows, {}, [](const auto& row) { return row.first; });
  return rows;
}

}  // namespace

std::vector<stats::MatchCounts> cells_of(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer,
                                         bool of_opportunities) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, stats::MatchCounts> cells;
  for (const Opportunity& o : dataset.opportunities) {
    if (!of_opportunities && o.ending != Ending::kInside && o.ending != Ending::kOutside) continue;
    if (o.group != older && o.group != newer) continue;
    const stats::MatchCounts empty{o.match, o.stratum, {}, {}, o.calibration};
    stats::MatchCounts& cell = cells.try_emplace({o.match, o.calibration, o.stratum}, empty).first->second;
    add(o.group == older ? cell.older : cell.newer, o.ending);
  }
  std::vector<stats::MatchCounts> result;
  result.reserve(cells.size());
  for (const auto& [key, cell] : cells) result.push_back(cell);
  return result;
}

PairedOpportunities paired_opportunities(const KickDataset& dataset, std::uint32_t older, std::uint32_t newer) {
  const auto a = keyed(dataset, older), b = keyed(dataset, newer);
  PairedOpportunities result;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i].first != b[j].first) {
      ++(a[i].first < b[j].first ? i : j);
      ++result.unpaired;
      continue;
    }
    const Ending x = a[i++].second, y = b[j].second;
    const auto [match, calibration, id, setting] = b[j++].first;
    const bool x_in = x == Ending::kInside, y_in = y == Ending::kInside;
    ++(x_in && y_in ? result.counts.both
       : y_in       ? result.counts.newer_only
       : x_in       ? result.counts.older_only
                    : result.counts.neither);
    if (result.cells.empty() || result.cells.back().match != match || result.cells.back().calibration != calibration)
      result.cells.push_back({match, 0, {}, {}, calibration});
    add(result.cells.back().older, x);
    add(result.cells.back().newer, y);
  }
  result.unpaired += static_cast<std::int64_t>(a.size() - i + b.size() - j);
  return result;
}

}  // namespace trivela::evaluator
