#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::kicking {

/// Letters that have to be put in, left out, replaced or swapped with their neighbour to make one word of the other
/// (Damerau's distance, each letter touched once).
inline std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before(to.size() + 1), last(to.size() + 1), now(to.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const bool same = from[i - 1] == to[j - 1];
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last.back();
}

/// The word that was probably meant: the nearest one, the first of several; none where more than a third of its letters
/// would have to change.
inline std::optional<std::string> nearest_word(std::string_view typed, const std::vector<std::string>& words) {
  const auto distance = [&](const std::string& word) { return edit_distance(typed, word); };
  const auto nearest = std::ranges::min_element(words, {}, distance);
  if (nearest == words.end() || 3 * distance(*nearest) > std::max<std::size_t>(nearest->size(), 3)) return std::nullopt;
  return *nearest;
}

}  // namespace trivela::kicking
