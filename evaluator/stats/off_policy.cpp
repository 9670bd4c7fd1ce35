#include "evaluator/stats/off_policy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>

#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/logistic_ridge.hpp"

namespace trivela::evaluator::stats {
namespace {

constexpr std::size_t kFolds = 5;
constexpr double kRidge = 1.0;  // one standardised unit counts like a standard normal prior

double weight(const Trial& trial) { return trial.by_target ? 1.0 / trial.probability : 0.0; }

Eigen::VectorXd vector_of(const Context& context) {
  return Eigen::Map<const Eigen::VectorXd>(context.data(), static_cast<Eigen::Index>(kContext));
}

// Fold of each trial: by its match, so that no trial is predicted from its own match.
std::vector<std::size_t> folds_of(std::span<const Trial> trials) {
  std::map<std::uint32_t, std::size_t> number;
  for (const Trial& trial : trials) number.try_emplace(trial.match, number.size());
  std::vector<std::size_t> folds;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    folds.push_back((number.size() < kFolds ? i : number.at(trials[i].match)) % kFolds);
  }
  return folds;
}

std::vector<double> predictions(std::span<const Trial> trials) {
  const auto folds = folds_of(trials);
  std::vector<double> predicted(trials.size());
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (trials[i].by_target && folds[i] != fold) others.push_back(i);
    }
    Eigen::MatrixXd x(static_cast<Eigen::Index>(others.size()), static_cast<Eigen::Index>(kContext));
    Eigen::VectorXd y(static_cast<Eigen::Index>(others.size()));
    for (std::size_t row = 0; row < others.size(); ++row) {
      x.row(static_cast<Eigen::Index>(row)) = vector_of(trials[others[row]].context).transpose();
      y[static_cast<Eigen::Index>(row)] = trials[others[row]].reward;
    }
    const LogisticFit fit = logistic_ridge(x, y, kRidge);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (folds[i] == fold) predicted[i] = fit.probability(vector_of(trials[i].context));
    }
  }
  return predicted;
}

// Mean of `scores`, one a trial, divided by `divisor` (1 where the scores are the estimate's), its variance from the
// sums of score - value * (divisor of that trial) over matches.
PolicyValue mean_of(std::span<const Trial> trials, const std::vector<double>& scores, const std::vector<double>& parts,
                    bool by_match, double confidence) {
  double sum = 0.0, divisor = 0.0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    sum += scores[i];
    divisor += parts[i];
  }
  const double value = sum / divisor;
  std::vector<Influence> influences, of_trials;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::uint32_t unit = by_match ? trials[i].match : static_cast<std::uint32_t>(i);
    influences.push_back({.match = unit, .u = (scores[i] - value * parts[i]) / divisor});
    of_trials.push_back({.match = static_cast<std::uint32_t>(i), .u = influences.back().u});
  }
  const ClusterVariance spread = cluster_variance(influences).value_or(ClusterVariance{});
  double half_width = by_match ? spread.reach(confidence) : z_of(confidence) * std::sqrt(spread.variance);
  // Few matches, or trials, that happen to be alike show less than independent ones would.
  if (by_match && spread.matches < kManyMatches) {
    const double independent = cluster_variance(of_trials).value_or(ClusterVariance{}).variance;
    half_width = std::max(half_width, z_of(confidence) * std::sqrt(independent));
  }
  if (half_width == 0.0) {
    const double n = effective_sample_size(trials) + 4.0, p = ((n - 4.0) * std::clamp(value, 0.0, 1.0) + 2.0) / n;
    half_width = z_of(confidence) * std::sqrt(p * (1.0 - p) / n);  // Agresti and Coull (1998)
  }
  return {value,
          {std::max(value - half_width, std::min(value, 0.0)), std::min(value + half_width, std::max(value, 1.0))}};
}

}  // namespace

double effective_sample_size(std::span<const Trial> trials) {
  double sum = 0.0, squares = 0.0;
  for (const Trial& trial : trials) {
    sum += weight(trial);
    squares += weight(trial) * weight(trial);
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

OffPolicy off_policy_value(std::span<const Trial> trials, double confidence) {
  OffPolicy result;
  result.trials = trials.size();
  result.effective_sample_size = effective_sample_size(trials);
  assert(result.effective_sample_size > 0.0);
  std::set<std::uint32_t> matches;
  for (const Trial& trial : trials) {
    result.logged += trial.reward / static_cast<double>(trials.size());
    result.by_target += trial.by_target ? 1 : 0;
    result.largest_weight = std::max(result.largest_weight, weight(trial));
    matches.insert(trial.match);
  }
  result.matches = matches.size();
  result.by_match = result.matches >= kFewestMatches;
  const double n = static_cast<double>(trials.size());
  double mean = 0.0, squares = 0.0;
  for (const Trial& trial : trials) mean += weight(trial) / n;
  for (const Trial& trial : trials) squares += (weight(trial) - mean) * (weight(trial) - mean);
  result.mean_weight = mean;
  result.mean_weight_p =
      squares > 0.0 && n > 1.0 ? two_sided_p((mean - 1.0) / std::sqrt(squares / (n - 1.0) / n)) : 1.0;
  const std::vector<double> model = predictions(trials);
  const std::vector<double> ones(trials.size(), 1.0);
  std::vector<double> weights, weighted, robust;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    weights.push_back(weight(trials[i]));
    weighted.push_back(weights[i] * trials[i].reward);
    robust.push_back(model[i] + weights[i] * (trials[i].reward - model[i]));
  }
  result.ips = mean_of(trials, weighted, ones, result.by_match, confidence);
  result.snips = mean_of(trials, weighted, weights, result.by_match, confidence);
  result.doubly_robust = mean_of(trials, robust, ones, result.by_match, confidence);
  return result;
}

}  // namespace trivela::evaluator::stats
