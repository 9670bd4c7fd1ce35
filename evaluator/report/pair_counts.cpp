#include "evaluator/report/pair_counts.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace trivela::evaluator {
namespace {

using PairKey = std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>;  // match, id, setting

// Endings of a group in the order of their keys.
std::vector<std::pair<PairKey, Ending>> keyed(const KickBook& book, std::uint32_t group) {
  std::vector<std::pair<PairKey, Ending>> rows;
  for (const Opportunity& o : book.opportunities) {
    if (o.group == group && o.id != 0) rows.push_back({{o.match, o.id, o.setting}, o.ending});
  }
  std::ranges::stable_sort(rows, {}, [](const auto& row) { return row.first; });
  return rows;
}

}  // namespace

std::vector<stats::MatchCounts> cells_of(const KickBook& book, std::uint32_t older, std::uint32_t newer,
                                         bool of_opportunities) {
  const std::size_t strata = book.strata.size() + 1;
  std::vector<stats::MatchCounts> cells(std::max<std::size_t>(book.matches, 1) * strata);
  for (const Opportunity& o : book.opportunities) {
    if (!of_opportunities && o.ending != Ending::kInside && o.ending != Ending::kOutside) continue;
    if (o.group != older && o.group != newer) continue;
    stats::MatchCounts& cell = cells[o.match * strata + o.stratum];
    add(o.group == older ? cell.older : cell.newer, o.ending);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i].match = static_cast<std::uint32_t>(i / strata);
    cells[i].stratum = static_cast<std::uint32_t>(i % strata);
  }
  std::erase_if(cells, [](const auto& cell) { return cell.older.n + cell.newer.n == 0; });
  return cells;
}

PairedOpportunities paired_opportunities(const KickBook& book, std::uint32_t older, std::uint32_t newer) {
  const auto a = keyed(book, older), b = keyed(book, newer);
  PairedOpportunities result;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i].first != b[j].first) {
      ++(a[i].first < b[j].first ? i : j);
      ++result.unpaired;
      continue;
    }
    const Ending x = a[i++].second, y = b[j].second;
    const std::uint32_t match = std::get<0>(b[j++].first);
    const bool x_in = x == Ending::kInside, y_in = y == Ending::kInside;
    ++(x_in && y_in ? result.counts.both
       : y_in       ? result.counts.newer_only
       : x_in       ? result.counts.older_only
                    : result.counts.neither);
    if (result.cells.empty() || result.cells.back().match != match) result.cells.push_back({match, 0, {}, {}});
    add(result.cells.back().older, x);
    add(result.cells.back().newer, y);
  }
  result.unpaired += static_cast<std::int64_t>(a.size() - i + b.size() - j);
  return result;
}

}  // namespace trivela::evaluator
