#pragma once

#include <string>
#include <string_view>

#include "evaluator/stats/counts/interval.hpp"
#include "kicking/range.hpp"
#include "python/arrays.hpp"

/// What single arguments are held to. Each throws ValueError naming argument and value.
namespace trivela::python {

/// The range that the configuration has for the number `key` of S, whose `fields` the caller includes.
template <class S>
kicking::Range range_of(std::string_view key) {
  kicking::Range found{kNone, kNone};
  const auto look = [&](std::string_view name, const double&, kicking::Range range) {
    if (name == key) found = range;
  };
  S defaults;
  fields(look, defaults);
  return found;
}

void require_within(const char* name, double value, kicking::Range range);

/// Radius of a ball [m].
void require_ball_radius(double ball_radius_m);

/// 0 to kMaxKicks.
void require_count(const std::string& name, std::int64_t count);

/// `inside` of `n` kicks.
void require_counts(const std::string& inside_name, const std::string& n_name, evaluator::stats::Counts counts);

/// A confidence, a power or a level: between 0 and 1, and so far from both that every quantile is a number.
void require_level(const char* name, double level);

}  // namespace trivela::python
