#include <fmt/format.h>

#include <filesystem>

#include "cli/calibrate/robot_file.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/study/study.hpp"
#include "cli/verbs.hpp"
#include "config/learned_model.hpp"
#include "evaluator/learning/learned_fit.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/table.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;
using evaluator::HeldOutLoss;
using evaluator::Json;
using evaluator::json_of;
using evaluator::LearnedFit;
using kicking::LearnedModel;

struct LearnFlags {
  std::vector<std::string> logs;
  std::string out = "learned.toml";
  evaluator::LearnOptions options;
  bool shadows = false;
  bool anyway = false;
  bool json = false;
};

config::LearnedModelFile file_of(const LearnedFit& fit, const LearnFlags& flags) {
  const HeldOutLoss& loss = fit.held_out;
  config::LearnedModelFile file{.model = fit.model, .training = {}, .held_out = {}};
  file.training = {.source = "trivela study learn",
                   .date = today(),
                   .files = {},
                   .matches = static_cast<std::uint32_t>(fit.matches),
                   .kicks = static_cast<std::uint32_t>(fit.kicks),
                   .ridge = fit.ridge};
  for (const std::string& log : flags.logs) file.training.files.push_back(fs::path{log}.filename().string());
  file.held_out = {.matches = static_cast<std::uint32_t>(loss.matches),
                   .kicks = static_cast<std::uint32_t>(loss.kicks),
                   .log_loss_learned = loss.learned,
                   .log_loss_predictive = loss.predictive,
                   .difference = loss.difference,
                   .difference_low = loss.ci.lo,
                   .difference_high = loss.ci.hi,
                   .better = loss.better()};
  return file;
}

std::string verdict(const HeldOutLoss& loss) {
  if (loss.better()) return "better than predictive's own probability on held-out matches";
  return loss.ci.lo > 0.0 ? "worse than predictive's own probability on held-out matches"
                          : "not better than predictive's own probability: the interval contains 0";
}

evaluator::Table deciles_of(const HeldOutLoss& loss) {
  evaluator::Table table{{{"", "tenth"},
                          {"kicks", "kicks"},
                          {"predictive", "predictive", "{:.1f} %", 100.0},
                          {"learned", "learned", "{:.1f} %", 100.0},
                          {"on_target", "", ""},
                          {"", "observed", "{:.1f} %", 100.0},
                          {"observed_ci", "", ""},
                          {"", "95 %"}}};
  for (const auto& d : loss.deciles)
    table.rows.push_back({table.rows.size() + 1, d.kicks, d.predictive, d.learned, d.observed.inside,
                          *evaluator::stats::efficiency(d.observed), json_of(d.observed_ci),
                          evaluator::percent(d.observed_ci)});
  return table;
}

evaluator::Table features_of(const LearnedModel& model) {
  evaluator::Table table{
      {{"name", "feature"}, {"weight", "weight", "{:+.4f}"}, {"mean", "mean", "{:.4g}"}, {"scale", "scale", "{:.4g}"}}};
  for (std::size_t i = 0; i < LearnedModel::kFeatures; ++i)
    table.rows.push_back({LearnedModel::kFeatureNames[i], model.weights[i], model.means[i], model.scales[i]});
  return table;
}

std::string text_of(const LearnedFit& fit) {
  const HeldOutLoss& loss = fit.held_out;
  const std::string text = fmt::format(
      "Trained on {} kicks of {} matches, ridge {:g}; held out {} kicks of {} other matches.\n\n"
      "log loss on held-out kicks: learned {:.4f}, predictive {:.4f}\n"
      "difference {:+.4f}, 95 % interval {:+.4f} to {:+.4f} (by match): {}\n\n",
      fit.kicks, fit.matches, fit.ridge, loss.kicks, loss.matches, loss.learned, loss.predictive, loss.difference,
      loss.ci.lo, loss.ci.hi, verdict(loss));
  return text + evaluator::text_table(texts_of(deciles_of(loss))) + "\n" +
         evaluator::text_table(texts_of(features_of(fit.model))) +
         fmt::format("logit p = logit P {:+.4f} + sum of weight (x - mean) / scale\n", fit.model.intercept);
}

Json to_json(const LearnedFit& fit, const std::string& written) {
  const HeldOutLoss& loss = fit.held_out;
  return {{"training", {{"kicks", fit.kicks}, {"matches", fit.matches}, {"ridge", fit.ridge}}},
          {"held_out",
           {{"kicks", loss.kicks},
            {"matches", loss.matches},
            {"log_loss_learned", loss.learned},
            {"log_loss_predictive", loss.predictive},
            {"difference", loss.difference},
            {"difference_ci", json_of(loss.ci)},
            {"better", loss.better()}}},
          {"deciles", rows_json(deciles_of(loss))},
          {"model", {{"intercept", fit.model.intercept}, {"features", rows_json(features_of(fit.model))}}},
          {"file", written.empty() ? Json() : Json(written)}};
}

int learn(const LearnFlags& flags) {
  require_writable("--out", flags.out);
  const auto source = flags.shadows ? evaluator::PredictionSource::kAndShadows : evaluator::PredictionSource::kInCharge;
  ProgressBar bar;
  const auto shown = [&](const char* unit, const char* what) {
    return [&bar, unit, what](std::size_t done, std::size_t all) {
      bar.show(static_cast<double>(done), static_cast<double>(all), unit, what);
    };
  };
  const auto logged =
      evaluator::predicted_kicks({flags.logs.begin(), flags.logs.end()}, source, shown("logs", "kicks are read"));
  bar.end();
  for (const std::string& remark : logged.remarks) warn(remark);
  evaluator::LearnOptions options = flags.options;
  options.progress = shown("fits", "the ridge is chosen");
  const LearnedFit fit = evaluator::fit_learned_model(logged.kicks, options);
  bar.end();
  const bool better = fit.held_out.better();
  const std::string written = better || flags.anyway ? flags.out : "";
  if (!written.empty()) {
    write_file(written,
               fmt::format("# Correction of the predictive policy's probability, for kick_decision.learned_model.\n"
                           "# Held out: {}.\n",
                           verdict(fit.held_out)) +
                   config::to_toml_text(file_of(fit, flags)));
  }
  flags.json ? fmt::print("{}", evaluator::json_text(to_json(fit, written))) : say(text_of(fit));
  if (!flags.json && !written.empty()) fmt::print("\nWritten: {}\n", written);
  if (better) return kDone;
  fmt::print(stderr, "trivela: the learned model is {}; {}\n", verdict(fit.held_out),
             flags.anyway ? "written all the same (--anyway)" : "no model is written");
  return kDoneWithLoss;
}

}  // namespace

void add_learn(CLI::App& study, int& exit_code) {
  const auto [verb, flags] =
      add_verb(study, exit_code, "learn", "Train the learned policy's correction on match logs", learn);
  verb->add_option("log", flags->logs, "Match logs with kicks of the predictive policy")
      ->required()
      ->check(readable_file());
  add_default(*verb, "--out", flags->out, "The model's file")->type_name("FILE");
  add_default(*verb, "--held-out", flags->options.held_out_share, "Share of the matches that the fit does not see",
              CLI::Range(0.1, 0.9));
  add_default(*verb, "--folds", flags->options.folds, "Of the cross-validation by match that chooses the ridge",
              CLI::Range(2, 100));
  add_default(*verb, "--seed", flags->options.seed, "Which matches are held out", seeds());
  verb->add_flag("--shadows", flags->shadows,
                 "Also kicks of other policies, with the probability that predictive gave its own kick of that cycle");
  verb->add_flag("--anyway", flags->anyway, "Write the model even where it is not better");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(
      "Observed outcomes alone, never the simulator's truth. Exit code 3: on held-out matches the model is not better\n"
      "than predictive's own probability (95 % interval of the log loss's difference), and no file is written.");
}

}  // namespace trivela::cli
