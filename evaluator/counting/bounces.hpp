#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

/// Balls inside that touched the floor before the line, of those of which it was said: by the robots' observer, and by
/// the simulator's truth, which matches without simulation have not.
struct Bounces {
  std::int64_t observed = 0;
  std::int64_t observed_bounced = 0;
  std::int64_t truth = 0;
  std::int64_t truth_bounced = 0;
};

struct NamedBounces {
  std::string name;
  Bounces bounces;
};

/// "  bounced before the line, of those inside, ...: stopped 16 of 31, moving 40 of 95", a line for each that says it;
/// empty where nobody does.
std::string bounce_lines(std::span<const NamedBounces> groups);

/// {"observed": {"bounced", "of"}, "truth": ...}; null where nobody says it.
Json bounces_json(const Bounces& bounces);

}  // namespace trivela::evaluator
