#pragma once

#include <initializer_list>

#include "evaluator/stats/counts/interval.hpp"

namespace trivela::evaluator::stats {

/// Inside and outside exchanged.
inline Counts exchanged(Counts counts) { return {counts.n - counts.inside, counts.n}; }

/// Calls `fn` with every pair of groups of some sizes up to n_max, every count inside.
template <typename Fn>
void for_pairs(std::int64_t n_max, Fn fn) {
  for (const std::int64_t n1 : {std::int64_t{0}, std::int64_t{1}, std::int64_t{3}, n_max - 1, n_max}) {
    for (const std::int64_t n2 : {std::int64_t{0}, std::int64_t{2}, n_max}) {
      for (std::int64_t k1 = 0; k1 <= n1; ++k1) {
        for (std::int64_t k2 = 0; k2 <= n2; ++k2) fn(Counts{k1, n1}, Counts{k2, n2});
      }
    }
  }
}

}  // namespace trivela::evaluator::stats
