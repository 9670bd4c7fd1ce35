#include "python/checks.hpp"

#include "evaluator/stats/counts/most_kicks.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::python {

using evaluator::stats::kMaxKicks;

void require_within(const char* name, double value, kicking::Range range) {
  if (range.contains(value)) return;
  throw py::value_error(fmt::format("{}: '{:g}' is not from {:g} to {:g}", name, value, range.min, range.max));
}

void require_ball_radius(double ball_radius_m) {
  require_within("ball_radius_m", ball_radius_m, range_of<sim::BallPhysics>("radius_m"));
}

void require_count(const std::string& name, std::int64_t count) {
  if (count < 0) throw py::value_error(fmt::format("{}: '{}': a count cannot be negative", name, count));
  if (count > kMaxKicks) throw py::value_error(fmt::format("{}: '{}' is more than {}", name, count, kMaxKicks));
}

void require_counts(const std::string& inside_name, const std::string& n_name, evaluator::stats::Counts counts) {
  require_count(inside_name, counts.inside);
  require_count(n_name, counts.n);
  if (counts.inside <= counts.n) return;
  throw py::value_error(fmt::format("{}: {} inside of only {} kicks", inside_name, counts.inside, counts.n));
}

void require_level(const char* name, double level) {
  constexpr double kNearest = 1e-15;
  if (!(level > 0.0 && level < 1.0)) throw py::value_error(fmt::format("{} {} is not between 0 and 1", name, level));
  if (level < kNearest || 1.0 - level < kNearest)
    throw py::value_error(fmt::format("{} {} is nearer to 0 or 1 than {}", name, level, kNearest));
}

}  // namespace trivela::python
