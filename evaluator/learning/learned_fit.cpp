#include "evaluator/learning/learned_fit.hpp"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "evaluator/metrics/predicted_kicks.sql.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "evaluator/stats/clustered.hpp"
#include "evaluator/stats/logistic_ridge.hpp"
#include "kicking/outcome/outcome.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {
namespace {

using kicking::LearnedModel;
using Kicks = std::vector<PredictedKick>;

constexpr std::size_t kFewestMatches = 10;
constexpr std::size_t kDeciles = 10;

double log_loss(double p, bool on_target) { return -std::log(std::max(1e-12, on_target ? p : 1.0 - p)); }

/// As the model sees it: within [1e-4, 1 - 1e-4].
double physical_p(const PredictedKick& kick) { return kicking::logistic(kicking::held_logit(kick.shot.p_on_target)); }

/// The matches in an order that the seed draws.
std::vector<std::uint32_t> shuffled_matches(std::span<const PredictedKick> kicks, std::uint64_t seed) {
  std::set<std::uint32_t> distinct;
  for (const PredictedKick& kick : kicks) distinct.insert(kick.match);
  std::vector<std::uint32_t> matches(distinct.begin(), distinct.end());
  std::mt19937_64 engine{seed};
  for (std::size_t i = matches.size(); i > 1; --i) std::swap(matches[i - 1], matches[engine() % i]);
  return matches;
}

Kicks of_matches(std::span<const PredictedKick> kicks, std::span<const std::uint32_t> matches) {
  const std::set<std::uint32_t> chosen(matches.begin(), matches.end());
  Kicks out;
  std::ranges::copy_if(kicks, std::back_inserter(out), [&](const auto& kick) { return chosen.contains(kick.match); });
  return out;
}

LearnedModel train(std::span<const PredictedKick> kicks, double ridge) {
  const auto rows = static_cast<Eigen::Index>(kicks.size());
  constexpr auto kColumns = static_cast<Eigen::Index>(LearnedModel::kFeatures);
  Eigen::MatrixXd x(rows, kColumns);
  Eigen::VectorXd y(rows), offset(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const PredictedKick& kick = kicks[static_cast<std::size_t>(i)];
    const LearnedModel::Row row = LearnedModel::row_of(kick.shot);
    for (Eigen::Index j = 0; j < kColumns; ++j) x(i, j) = row[static_cast<std::size_t>(j)];
    y[i] = kick.on_target ? 1.0 : 0.0;
    offset[i] = row[0];
  }
  const stats::LogisticFit fit = stats::logistic_ridge(x, y, ridge, offset);
  LearnedModel model;
  model.intercept = fit.intercept;
  std::ranges::copy(fit.weights, model.weights.begin());
  std::ranges::copy(fit.means, model.means.begin());
  std::ranges::copy(fit.scales, model.scales.begin());
  return model;
}

double mean_loss(const LearnedModel& model, std::span<const PredictedKick> kicks) {
  double sum = 0.0;
  for (const PredictedKick& kick : kicks) sum += log_loss(model.p_on_target(kick.shot), kick.on_target);
  return sum / static_cast<double>(kicks.size());
}

bool has_both_outcomes(std::span<const PredictedKick> kicks) {
  return std::ranges::any_of(kicks, &PredictedKick::on_target) &&
         !std::ranges::all_of(kicks, &PredictedKick::on_target);
}

/// The ridge of least mean loss over the folds; folds without both outcomes on either side say nothing.
double choose_ridge(std::span<const PredictedKick> kicks, std::span<const std::uint32_t> matches,
                    const LearnOptions& options) {
  std::vector<double> losses(options.ridges.size(), 0.0);
  const auto folds = static_cast<std::size_t>(options.folds);
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<std::uint32_t> inside, outside;
    for (std::size_t i = 0; i < matches.size(); ++i) (i % folds == fold ? outside : inside).push_back(matches[i]);
    const Kicks training = of_matches(kicks, inside), tested = of_matches(kicks, outside);
    if (tested.empty() || !has_both_outcomes(training)) continue;
    for (std::size_t i = 0; i < losses.size(); ++i) {
      if (options.progress) options.progress(fold * losses.size() + i, folds * losses.size());
      losses[i] += mean_loss(train(training, options.ridges[i]), tested) * static_cast<double>(tested.size());
    }
  }
  const auto least = std::ranges::min_element(losses) - losses.begin();
  return options.ridges[static_cast<std::size_t>(least)];
}

void check(std::span<const PredictedKick> kicks, std::size_t matches) {
  if (kicks.empty()) {
    throw std::runtime_error(
        "no kick with a predicted probability and an observed outcome: play the policy predictive");
  }
  if (matches < kFewestMatches) {
    throw std::runtime_error(fmt::format("{} {} with predicted kicks, need {} to split them by match", matches,
                                         matches == 1 ? "match" : "matches", kFewestMatches));
  }
  for (const PredictedKick& kick : kicks) {
    const LearnedModel::Row row = LearnedModel::row_of(kick.shot);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (std::isfinite(row[i])) continue;
      throw std::runtime_error(fmt::format("a kick's {} is not finite", LearnedModel::kFeatureNames[i]));
    }
  }
}

std::vector<Decile> deciles_of(const LearnedModel& model, std::span<const PredictedKick> kicks) {
  struct Prediction {
    double learned;
    const PredictedKick* kick;
  };
  std::vector<Prediction> predictions;
  for (const PredictedKick& kick : kicks) predictions.push_back({model.p_on_target(kick.shot), &kick});
  std::ranges::sort(predictions, {}, &Prediction::learned);
  std::vector<Decile> deciles;
  for (std::size_t i = 0; i < kDeciles; ++i) {
    const std::size_t from = predictions.size() * i / kDeciles, to = predictions.size() * (i + 1) / kDeciles;
    if (from == to) continue;
    Decile decile;
    for (const Prediction& prediction : std::span(predictions).subspan(from, to - from)) {
      ++decile.kicks;
      decile.predictive += physical_p(*prediction.kick);
      decile.learned += prediction.learned;
      decile.observed.inside += prediction.kick->on_target ? 1 : 0;
    }
    decile.observed.n = decile.kicks;
    decile.predictive /= static_cast<double>(decile.kicks);
    decile.learned /= static_cast<double>(decile.kicks);
    decile.observed_ci = stats::wilson(decile.observed);
    deciles.push_back(decile);
  }
  return deciles;
}

/// The losses of a model on kicks that it has not seen.
HeldOutLoss held_out_loss(const LearnedModel& model, std::span<const PredictedKick> kicks) {
  HeldOutLoss out;
  std::map<std::uint32_t, std::pair<double, double>> by_match;  // sum of differences, kicks
  const auto n = static_cast<double>(kicks.size());
  for (const PredictedKick& kick : kicks) {
    const double learned = log_loss(model.p_on_target(kick.shot), kick.on_target);
    const double predictive = log_loss(physical_p(kick), kick.on_target);
    out.learned += learned / n;
    out.predictive += predictive / n;
    auto& [sum, count] = by_match[kick.match];
    sum += learned - predictive;
    count += 1.0;
  }
  if (by_match.size() < stats::kFewestMatches) {
    throw std::runtime_error(fmt::format("{} held-out {} with kicks, need {} for an interval", by_match.size(),
                                         by_match.size() == 1 ? "match" : "matches", stats::kFewestMatches));
  }
  out.kicks = static_cast<std::int64_t>(kicks.size());
  out.matches = static_cast<std::int64_t>(by_match.size());
  out.difference = out.learned - out.predictive;
  std::vector<stats::Influence> of_sum;
  of_sum.reserve(by_match.size());
  for (const auto& [match, cell] : by_match) of_sum.push_back({match, 0, cell.first - cell.second * out.difference});
  const stats::ClusterVariance spread = *stats::cluster_variance(of_sum);
  const double reach = stats::t_of(stats::kConfidence, spread.df) * (std::sqrt(spread.variance) / n);
  out.ci = {out.difference - reach, out.difference + reach};
  out.deciles = deciles_of(model, kicks);
  return out;
}

}  // namespace

PredictedKicks predicted_kicks(const std::vector<std::filesystem::path>& logs, PredictionSource source,
                               const std::function<void(std::size_t, std::size_t)>& told) {
  struct Recorded {
    std::uint32_t session;
    int robot_id;
    std::int64_t kick_id;
    PredictedKick kick;
  };
  std::vector<Recorded> recorded;
  SessionIndex sessions_read;
  for (const std::filesystem::path& path : logs) {
    told(static_cast<std::size_t>(&path - logs.data()), logs.size());
    const log::Reader reader{path};
    const SessionPlaces fresh = sessions_read.add(reader, path.string());
    reader.query(kPredictedKicksSql, [&](const log::NamedCells& row) {
      if (source == PredictionSource::kInCharge && row.get<std::string>("policy") != "predictive") return;
      const auto session = fresh.find(row.get<std::int64_t>("session_id"));
      if (session == fresh.end()) return;
      recorded.push_back({session->second, row.get<int>("robot_id"), row.get<std::int64_t>("kick_id"),
                          PredictedKick{.match = 0,
                                        .shot = {.p_on_target = row.get<double>("p_on_target"),
                                                 .distance_m = row.get<double>("distance_m"),
                                                 .vx_mps = row.get<double>("vx_mps"),
                                                 .vy_mps = row.get<double>("vy_mps"),
                                                 .omega_radps = row.get<double>("omega_radps"),
                                                 .power = row.get<double>("power"),
                                                 .opponent_distance_m = row.find<double>("opponent_distance_m")},
                                        .on_target = row.get<bool>("on_target")}});
    });
  }
  sessions_read.refuse_replays_alone();
  sessions_read.settle();
  PredictedKicks out{.kicks = {}, .remarks = sessions_read.remarks()};
  out.remarks.insert(out.remarks.end(), sessions_read.not_counted().begin(), sessions_read.not_counted().end());
  std::map<std::uint32_t, std::uint32_t> numbers;  // of the matches with a kick
  for (Recorded& r : recorded) {
    if (!sessions_read.counts(r.session, r.robot_id, r.kick_id)) continue;
    const std::uint32_t match = sessions_read.sessions()[r.session].match;
    r.kick.match = numbers.try_emplace(match, static_cast<std::uint32_t>(numbers.size())).first->second;
    out.kicks.push_back(r.kick);
  }
  return out;
}

LearnedFit fit_learned_model(std::span<const PredictedKick> kicks, const LearnOptions& options) {
  const std::vector<std::uint32_t> matches = shuffled_matches(kicks, options.seed);
  check(kicks, matches.size());
  const auto held_out =
      static_cast<std::size_t>(std::ceil(options.held_out_share * static_cast<double>(matches.size())));
  const std::span<const std::uint32_t> tested_matches = std::span(matches).first(std::min(held_out, matches.size()));
  const std::span<const std::uint32_t> training_matches = std::span(matches).subspan(tested_matches.size());
  const Kicks training = of_matches(kicks, training_matches), tested = of_matches(kicks, tested_matches);
  if (training.size() < options.fewest_kicks) {
    throw std::runtime_error(fmt::format("{} kicks to learn from ({} are held out), need {}", training.size(),
                                         tested.size(), options.fewest_kicks));
  }
  if (!has_both_outcomes(training)) {
    throw std::runtime_error(fmt::format("all {} kicks to learn from have the same outcome ({})", training.size(),
                                         training.front().on_target ? "on target" : "not on target"));
  }
  LearnedFit fit{.kicks = static_cast<std::int64_t>(training.size()),
                 .matches = static_cast<std::int64_t>(training_matches.size()),
                 .ridge = choose_ridge(training, training_matches, options)};
  fit.model = train(training, fit.ridge);
  fit.held_out = held_out_loss(fit.model, tested);
  return fit;
}

}  // namespace trivela::evaluator
