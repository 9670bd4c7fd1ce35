#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/calibrate/robot_file.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/study/study.hpp"
#include "cli/verbs.hpp"
#include "config/learned_model.hpp"
#include "evaluator/learning/learned_fit.hpp"
#include "evaluator/render/json_values.hpp"
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

std::string text_of(const LearnedFit& fit) {
  const HeldOutLoss& loss = fit.held_out;
  std::string text = fmt::format(
      "Trained on {} kicks of {} matches, ridge {:g}; held out {} kicks of {} other matches.\n\n"
      "log loss on held-out kicks: learned {:.4f}, predictive {:.4f}\n"
      "difference {:+.4f}, 95 % interval {:+.4f} to {:+.4f} (by match): {}\n\n",
      fit.kicks, fit.matches, fit.ridge, loss.kicks, loss.matches, loss.learned, loss.predictive, loss.difference,
      loss.ci.lo, loss.ci.hi, verdict(loss));
  std::vector<std::vector<std::string>> rows{{"tenth", "kicks", "predictive", "learned", "observed", "95 %"}};
  for (std::size_t i = 0; i < loss.deciles.size(); ++i) {
    const auto& d = loss.deciles[i];
    rows.push_back(
        {std::to_string(i + 1), std::to_string(d.kicks), evaluator::percent(d.predictive),
         evaluator::percent(d.learned), evaluator::percent(*evaluator::stats::efficiency(d.observed)),
         fmt::format("{} to {}", evaluator::percent(d.observed_ci.lo), evaluator::percent(d.observed_ci.hi))});
  }
  text += evaluator::text_table(rows) + "\n";
  rows = {{"feature", "weight", "mean", "scale"}};
  for (std::size_t i = 0; i < LearnedModel::kFeatures; ++i) {
    rows.push_back({LearnedModel::kFeatureNames[i], fmt::format("{:+.4f}", fit.model.weights[i]),
                    fmt::format("{:.4g}", fit.model.means[i]), fmt::format("{:.4g}", fit.model.scales[i])});
  }
  return text + evaluator::text_table(rows) +
         fmt::format("logit p = logit P {:+.4f} + sum of weight (x - mean) / scale\n", fit.model.intercept);
}

Json to_json(const LearnedFit& fit, const std::string& written) {
  const HeldOutLoss& loss = fit.held_out;
  Json json{{"training", {{"kicks", fit.kicks}, {"matches", fit.matches}, {"ridge", fit.ridge}}},
            {"held_out",
             {{"kicks", loss.kicks},
              {"matches", loss.matches},
              {"log_loss_learned", loss.learned},
              {"log_loss_predictive", loss.predictive},
              {"difference", loss.difference},
              {"difference_ci", json_of(loss.ci)},
              {"better", loss.better()}}},
            {"deciles", Json::array()},
            {"model", {{"intercept", fit.model.intercept}, {"features", Json::array()}}},
            {"file", written.empty() ? Json() : Json(written)}};
  for (const auto& d : loss.deciles) {
    json["deciles"].push_back({{"kicks", d.kicks},
                               {"predictive", d.predictive},
                               {"learned", d.learned},
                               {"on_target", d.observed.inside},
                               {"observed_ci", json_of(d.observed_ci)}});
  }
  for (std::size_t i = 0; i < LearnedModel::kFeatures; ++i) {
    json["model"]["features"].push_back({{"name", LearnedModel::kFeatureNames[i]},
                                         {"weight", fit.model.weights[i]},
                                         {"mean", fit.model.means[i]},
                                         {"scale", fit.model.scales[i]}});
  }
  return json;
}

ExitCode learn(const LearnFlags& flags) {
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
  auto* const verb = study.add_subcommand("learn", "Train the learned policy's correction on match logs");
  const auto flags = std::make_shared<LearnFlags>();
  verb->add_option("log", flags->logs, "Match logs with kicks of the predictive policy")
      ->required()
      ->check(readable_file());
  verb->add_option("--out", flags->out, "The model's file")->capture_default_str()->type_name("FILE");
  verb->add_option("--held-out", flags->options.held_out_share, "Share of the matches that the fit does not see")
      ->check(CLI::Range(0.1, 0.9))
      ->capture_default_str();
  verb->add_option("--folds", flags->options.folds, "Of the cross-validation by match that chooses the ridge")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  verb->add_option("--seed", flags->options.seed, "Which matches are held out")->check(seeds())->capture_default_str();
  verb->add_flag("--shadows", flags->shadows,
                 "Also kicks of other policies, with the probability that predictive gave its own kick of that cycle");
  verb->add_flag("--anyway", flags->anyway, "Write the model even where it is not better");
  verb->add_flag("--json", flags->json, "JSON instead of text");
  verb->footer(
      "Observed outcomes alone, never the simulator's truth. Exit code 3: on held-out matches the model is not better\n"
      "than predictive's own probability (95 % interval of the log loss's difference), and no file is written.");
  verb->callback([flags, &exit_code] { exit_code = learn(*flags); });
}

}  // namespace trivela::cli
