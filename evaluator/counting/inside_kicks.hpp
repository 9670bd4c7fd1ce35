#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

/// Of how many balls inside something was said, and of how many it was so: by the robots' observer or a person, and by
/// the simulator's truth, which matches without simulation have not.
struct SaidOfInside {
  std::int64_t observed = 0;
  std::int64_t observed_yes = 0;
  std::int64_t truth = 0;
  std::int64_t truth_yes = 0;

  void add(std::optional<bool> seen, std::optional<bool> is) {
    observed += seen ? 1 : 0;
    observed_yes += seen.value_or(false) ? 1 : 0;
    truth += is ? 1 : 0;
    truth_yes += is.value_or(false) ? 1 : 0;
  }
  bool any() const { return observed_yes > 0 || truth_yes > 0; }
};

/// Balls inside: those that touched the floor before the line, and those that a keeper stopped.
struct InsideKicks {
  SaidOfInside bounced;
  SaidOfInside saved;
  std::int64_t by_people = 0;  ///< of which somebody says whether they were saved

  /// Goals are to be shown: a keeper saved something, or people say what were goals.
  bool goals() const { return saved.observed_yes > 0 || by_people > 0; }
};

struct NamedInside {
  std::string name;
  InsideKicks inside;
};

/// "  bounced before the line, of those inside, ...: stopped 16 of 31, moving 40 of 95" and "  saved by a keeper, ...",
/// a line for each that says it; of saves only where there are some. Empty where nobody says anything.
std::string inside_lines(std::span<const NamedInside> groups);

/// {"observed": {`what`, "of"}, "truth": ...}; null where nobody says it.
Json said_json(const SaidOfInside& said, const char* what);

}  // namespace trivela::evaluator
