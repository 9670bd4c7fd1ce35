#include "evaluator/stats/poisson.hpp"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "evaluator/stats/bias_reduced.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/counts/exact.hpp"

namespace trivela::evaluator::stats {

Interval rate_interval(Rate rate, double confidence) {
  if (!(rate.minutes > 0.0)) throw std::invalid_argument("a rate needs minutes above 0");
  const double tail = 0.5 * (1.0 - confidence);
  const auto k = static_cast<double>(rate.events);
  const double lo = rate.events > 0 ? boost::math::gamma_p_inv(k, tail) : 0.0;
  return {lo / rate.minutes, boost::math::gamma_q_inv(k + 1.0, tail) / rate.minutes};
}

std::optional<RateRatio> rate_ratio(Rate older, Rate newer, double confidence) {
  const Counts share{newer.events, newer.events + older.events};
  if (share.n == 0) return std::nullopt;
  const double time_ratio = older.minutes / newer.minutes;
  const auto ratio_of = [&](double p) {
    return p < 1.0 ? p / (1.0 - p) * time_ratio : std::numeric_limits<double>::infinity();
  };
  const Interval ci = clopper_pearson(share, confidence);
  return RateRatio{ratio_of(*efficiency(share)),
                   {ratio_of(ci.lo), ratio_of(ci.hi)},
                   binomial_two_sided(share, newer.minutes / (newer.minutes + older.minutes))};
}

std::optional<RateRatio> clustered_rate_ratio(std::span<const MatchRates> matches, double confidence) {
  std::vector<RatioPart> parts{{0.0, 0.0, 0.0, false}, {0.0, 0.0, 0.0, true}};
  std::vector<RatioCell> cells;
  std::array<std::size_t, 2> played{};
  for (const MatchRates& match : matches) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Rate& rate = i == 0 ? match.older : match.newer;
      if (!(rate.minutes > 0.0)) continue;
      cells.push_back({match.match, i, static_cast<double>(rate.events), rate.minutes});
      parts[i].x += cells.back().x;
      parts[i].n += cells.back().n;
      ++played[i];
    }
  }
  if (std::min(played[0], played[1]) < kFewestMatches || parts[0].x == 0.0 || parts[1].x == 0.0) return std::nullopt;
  for (RatioPart& part : parts) part.weight = (part.newer ? 1.0 : -1.0) * part.n / part.x;
  for (RatioCell& cell : cells) cell.spread = spread_of_events(cell.n * parts[cell.part].x / parts[cell.part].n);
  const BiasReduced log_ratio = bias_reduced(parts, cells);
  const double value = parts[1].x / parts[1].n / (parts[0].x / parts[0].n);
  // Few matches that happen to be alike show less than independent events would: their interval is no narrower.
  const bool few = std::min(played[0], played[1]) < kManyMatches || log_ratio.variance == 0.0;
  const double independent = 1.0 / parts[0].x + 1.0 / parts[1].x;
  const double floor = few ? independent * square(z_of(confidence) / t_of(confidence, log_ratio.df)) : 0.0;
  const double error = std::sqrt(std::max(log_ratio.variance, floor));
  const double reach = t_of(confidence, log_ratio.df) * error;
  const double p = student_p(std::log(value) / error, log_ratio.df);
  return RateRatio{value, {value * std::exp(-reach), value * std::exp(reach)}, p, true};
}

}  // namespace trivela::evaluator::stats
