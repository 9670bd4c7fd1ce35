#include "evaluator/stats/confidence_sequence.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>

namespace trivela::evaluator::stats {
namespace {

constexpr int kBits = 44;  // of a root

double inside(Counts counts) { return static_cast<double>(counts.inside); }
double outside(Counts counts) { return static_cast<double>(counts.n - counts.inside); }

// x log(p), which is nothing where x is.
double log_power(double x, double p) { return x == 0.0 ? 0.0 : x * std::log(p); }

double log_likelihood(Counts counts, double p) {
  return log_power(inside(counts), p) + log_power(outside(counts), 1.0 - p);
}

double log_mixture(Counts counts) {
  using boost::math::lgamma;
  return lgamma(inside(counts) + 1.0) + lgamma(outside(counts) + 1.0) - lgamma(static_cast<double>(counts.n) + 2.0);
}

// Of the log-likelihood by p; it falls with p.
double slope(Counts counts, double p) {
  const double up = counts.inside == 0 ? 0.0 : inside(counts) / p;
  const double down = counts.inside == counts.n ? 0.0 : outside(counts) / (1.0 - p);
  return up - down;
}

// Where `rises`, which is negative at one end and positive at the other, is 0.
template <typename Function>
double root(const Function& rises, double lo, double hi) {
  const auto bracket = boost::math::tools::bisect(rises, lo, hi, boost::math::tools::eps_tolerance<double>(kBits));
  return 0.5 * (bracket.first + bracket.second);
}

// Where the evidence, which rises from `best` towards `end`, comes to the limit; the end where it does not.
template <typename Evidence>
double edge(const Evidence& evidence, double best, double end, double limit) {
  const auto beyond = [&](double x) { return evidence(x) - limit; };
  if (best == end || beyond(end) <= 0.0) return end;
  return root(beyond, std::min(best, end), std::max(best, end));
}

double limit_of(double confidence) { return -std::log(1.0 - confidence); }

double best_of(Counts counts) { return efficiency(counts).value_or(0.5); }

}  // namespace

Interval confidence_sequence(Counts counts, double confidence) {
  if (counts.n == 0) return {0.0, 1.0};
  const double mixture = log_mixture(counts);
  const auto evidence = [&](double p) { return mixture - log_likelihood(counts, p); };
  const double best = best_of(counts);
  return {edge(evidence, best, 0.0, limit_of(confidence)), edge(evidence, best, 1.0, limit_of(confidence))};
}

double log_evidence_against(double difference, Counts older, Counts newer) {
  const double lo = std::max(0.0, -difference);
  const double hi = std::min(1.0, 1.0 - difference);
  const auto falls = [&](double p) { return -(slope(older, p) + slope(newer, p + difference)); };
  double likeliest = lo;  // the older group's proportion that speaks least against it
  if (falls(hi) < 0.0) {
    likeliest = hi;
  } else if (falls(lo) < 0.0) {
    likeliest = root(falls, lo, hi);
  }
  const double likelihood =
      log_likelihood(older, likeliest) + log_likelihood(newer, std::clamp(likeliest + difference, 0.0, 1.0));
  return log_mixture(older) + log_mixture(newer) - likelihood;
}

Interval difference_sequence(Counts older, Counts newer, double confidence) {
  if (older.n == 0 || newer.n == 0) return {-1.0, 1.0};
  const auto evidence = [&](double difference) { return log_evidence_against(difference, older, newer); };
  const double best = best_of(newer) - best_of(older);
  return {edge(evidence, best, -1.0, limit_of(confidence)), edge(evidence, best, 1.0, limit_of(confidence))};
}

double always_valid_p(Counts older, Counts newer) {
  return std::min(1.0, std::exp(-log_evidence_against(0.0, older, newer)));
}

}  // namespace trivela::evaluator::stats
