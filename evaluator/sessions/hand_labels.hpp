#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// Labels that people gave kicks that count, beside the observer's outcomes of the same kicks.
struct HandLabels {
  std::int64_t kicks = 0;              ///< with a label by hand
  std::int64_t compared = 0;           ///< of them, those of which both say what became of them
  std::int64_t disagreed = 0;          ///< of those compared, where the two differ
  std::int64_t observer_knew_not = 0;  ///< of the kicks, those of which the observer said nothing or "unknown"

  /// "hand labels: 12 kicks; they disagreed with the observer in 2 of 9, who did not know 3"; empty: there are none.
  std::string line() const;

  void add(const HandLabels& other);
};

/// Whether a label and an observed outcome contradict each other: "outside" is every miss, "goal" and "saved" are on
/// target.
bool disagree(const std::string& by_hand, const std::string& observed);

/// Of kicks in these sessions. Throws std::runtime_error where the log cannot be read.
HandLabels hand_labels_of(const log::Reader& reader, const std::set<std::int64_t>& sessions);

}  // namespace trivela::evaluator
