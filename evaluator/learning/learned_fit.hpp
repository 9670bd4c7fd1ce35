#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"
#include "kicking/policy/learned_model.hpp"

namespace trivela::evaluator {

/// A kick with the physical prediction for it, as the robot believed at the order, and what it saw of the flight.
struct PredictedKick {
  std::uint32_t match = 0;  ///< from 0; kicks of one match belong together
  kicking::ShotFeatures shot;
  bool on_target = false;  ///< observed
};

/// Which kicks of a log have a prediction that is theirs.
enum class PredictionSource {
  kInCharge,   ///< of the predictive policy itself
  kAndShadows  ///< also kicks of other policies, with what its shadow gave its own kick of the same cycle
};

/// The predicted kicks of match logs, and sentences on what was left out.
struct PredictedKicks {
  std::vector<PredictedKick> kicks;
  std::vector<std::string> remarks;
};

/// Reads the predicted kicks of match logs, each kick once, with its match, as SessionIndex says.
/// Throws std::runtime_error as log::Reader does.
/// `told(done, all)`: logs that were read.
PredictedKicks predicted_kicks(
    const std::vector<std::filesystem::path>& logs, PredictionSource source,
    const std::function<void(std::size_t done, std::size_t all)>& told = [](auto, auto) {});

/// How the training goes. Matches are drawn, never kicks: what a match has in common must not leak.
struct LearnOptions {
  double held_out_share = 0.3;  ///< of the matches
  int folds = 5;                ///< of the cross-validation that chooses the ridge, among the other matches
  std::vector<double> ridges{0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0};
  std::uint64_t seed = 1;          ///< of the draw of matches
  std::size_t fewest_kicks = 100;  ///< to learn from: ten a coefficient
  /// Told the fits of the cross-validation so far, and of how many; none: nobody asks.
  std::function<void(std::size_t done, std::size_t all)> progress{};
};

/// A tenth of the held-out kicks, by the learned probability.
struct Decile {
  std::int64_t kicks = 0;
  double predictive = 0.0;  ///< mean of the physical probabilities
  double learned = 0.0;     ///< mean of the learned ones
  stats::Counts observed;
  stats::Interval observed_ci;  ///< Wilson's, as if kicks were independent
};

/// Mean log loss - (y ln p + (1 - y) ln(1 - p)) on matches that the fit has not seen [nat].
struct HeldOutLoss {
  std::int64_t kicks = 0;
  std::int64_t matches = 0;
  double predictive = 0.0;
  double learned = 0.0;
  double difference = 0.0;  ///< learned - predictive, of the same kicks
  stats::Interval ci;       ///< of the difference, 95 %, matches as clusters
  std::vector<Decile> deciles;

  /// Does the whole interval say that the learned probability is better?
  bool better() const { return ci.hi < 0.0; }
};

/// A trained correction and how it did.
struct LearnedFit {
  kicking::LearnedModel model{};
  std::int64_t kicks = 0;  ///< of the training
  std::int64_t matches = 0;
  double ridge = 0.0;
  HeldOutLoss held_out{};
};

/// Trains LearnedModel: logistic regression with the logit of the physical probability as offset and a ridge penalty on
/// the standardised features (stats::logistic_ridge), so that with few kicks the physics stands. The ridge is the one
/// of least log loss in a cross-validation by match; the model is that of the training matches. The interval of the
/// difference: mean of d = loss_learned - loss_predictive over kicks, variance G / (G - 1) sum_m (sum_i (d_i -
/// mean))^2 / n^2 over the G held-out matches, Student's distribution with G - 1 degrees of freedom.
/// Throws std::runtime_error saying what is missing: fewer than 10 matches, 5 held-out matches with kicks or 100
/// training kicks, kicks of one outcome alone, or a feature that is not finite.
LearnedFit fit_learned_model(std::span<const PredictedKick> kicks, const LearnOptions& options = {});

}  // namespace trivela::evaluator
