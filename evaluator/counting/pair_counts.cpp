#include "evaluator/counting/pair_counts.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace trivela::evaluator {
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
