#include "config/learned_model.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::kicking {

void fields(auto& v, DriveStyle& s) {
  v("speed_ratio", s.speed_ratio, Range{-1.0, 2.0});
  v("side_ratio", s.side_ratio, Range{0.0, 10.0});
  v("brake_ratio", s.brake_ratio, Range{0.3, 5.0});
  v("aim_ratio", s.aim_ratio, Range{-1.0, 1.0});
}

}  // namespace trivela::kicking

namespace trivela::config {

using kicking::DriveStyle;
using kicking::LearnedDecision;
using kicking::LearnedModel;

/// [model] as the file has it.
struct ModelColumns {
  std::vector<std::string> features{LearnedModel::kFeatureNames.begin(), LearnedModel::kFeatureNames.end()};
  double intercept = 0.0;
  std::vector<double> weights, means, scales;
};

/// [decision] as the file has it.
struct DecisionColumns {
  std::vector<std::string> fire_features{kicking::kFireFeatureNames.begin(), kicking::kFireFeatureNames.end()};
  std::vector<double> fire_weights = std::vector<double>(kicking::kFireFeatures);
  LearnedDecision numbers;
  std::vector<DriveStyle> style{DriveStyle{}};
};

struct LearnedToml {
  ModelColumns model;
  DecisionColumns decision;
  TrainingOrigin training;
  HeldOut held_out;
};

inline constexpr Range kAny{-1e6, 1e6};
inline constexpr Range kNotNegative{0.0, 1e9};

void fields(auto& v, ModelColumns& m) {
  v("features", m.features);
  v("intercept", m.intercept, kAny);
  v("weights", m.weights, kAny);
  v("means", m.means, kAny);
  v("scales", m.scales, Range{1e-9, 1e6});
}

void fields(auto& v, DecisionColumns& d) {
  v("fire_features", d.fire_features);
  v("fire_weights", d.fire_weights, Range{-5.0, 5.0});
  LearnedDecision& n = d.numbers;
  constexpr Range kRatio{0.0, 10.0};
  v("threshold_ratio", n.threshold_ratio, kRatio);
  v("goal_threshold_ratio", n.goal_threshold_ratio, kRatio);
  v("position_ratio", n.position_ratio, kRatio);
  v("heading_ratio", n.heading_ratio, kRatio);
  v("speed_ratio", n.speed_ratio, kRatio);
  v("turn_rate_ratio", n.turn_rate_ratio, kRatio);
  v("hazard_ratio", n.hazard_ratio, kRatio);
  v("dispute_shift_m", n.dispute_shift_m, Range{-0.5, 0.5});
  v("switch_margin", n.switch_margin, Range{0.0, 1.0});
  v("blocking_ratio", n.blocking_ratio, Range{0.0, 2.0});
  v("opponent_places", n.opponent_places);
  v("lever_worth", n.lever_worth, Range{0.0, 1.0});
  v("style", d.style, DriveStyle{});
}

void fields(auto& v, TrainingOrigin& t) {
  v("source", t.source);
  v("date", t.date);
  v("files", t.files);
  v("matches", t.matches, kNotNegative);
  v("kicks", t.kicks, kNotNegative);
  v("ridge", t.ridge, kNotNegative);
}

void fields(auto& v, HeldOut& h) {
  v("matches", h.matches, kNotNegative);
  v("kicks", h.kicks, kNotNegative);
  v("log_loss_learned", h.log_loss_learned, kNotNegative);
  v("log_loss_predictive", h.log_loss_predictive, kNotNegative);
  v("difference", h.difference, kAny);
  v("difference_low", h.difference_low, kAny);
  v("difference_high", h.difference_high, kAny);
  v("better", h.better);
}

void fields(auto& v, LearnedToml& f) {
  v("model", f.model);
  v("decision", f.decision);
  v("training", f.training);
  v("held_out", f.held_out);
}

namespace {

void require_features(const std::vector<std::string>& read, const auto& own, const char* key, const std::string& file) {
  if (std::ranges::equal(read, own)) return;
  throw Error{fmt::format("{}: {} are not those of this program: {}", file, key, fmt::join(own, ", "))};
}

void take_row(const std::vector<double>& column, const char* key, const std::string& file, auto& row) {
  if (column.size() != row.size())
    throw Error{fmt::format("{}: {} has {} entries, need one for each of the {} features", file, key, column.size(),
                            row.size())};
  std::ranges::copy(column, row.begin());
}

LearnedDecision decision_of(const DecisionColumns& read, const std::string& file) {
  require_features(read.fire_features, kicking::kFireFeatureNames, "decision.fire_features", file);
  LearnedDecision decision = read.numbers;
  take_row(read.fire_weights, "decision.fire_weights", file, decision.fire_weights);
  if (read.style.empty() || read.style.size() > kicking::kDriveStyles) {
    throw Error{
        fmt::format("{}: {} of [[decision.style]], need 1 to {}", file, read.style.size(), kicking::kDriveStyles)};
  }
  decision.styles = read.style.size();
  std::ranges::copy(read.style, decision.style.begin());
  return decision;
}

DecisionColumns columns_of(const LearnedDecision& decision) {
  return {.fire_features = {kicking::kFireFeatureNames.begin(), kicking::kFireFeatureNames.end()},
          .fire_weights = {decision.fire_weights.begin(), decision.fire_weights.end()},
          .numbers = decision,
          .style = {decision.style.begin(), decision.style.begin() + static_cast<std::ptrdiff_t>(decision.styles)}};
}

}  // namespace

LearnedModelFile load_learned_model(const std::filesystem::path& path) {
  LearnedToml toml;
  const TomlSource source = parse_file(path);
  read_into(source, toml);
  require_features(toml.model.features, LearnedModel::kFeatureNames, "model.features", source.file);
  LearnedModel model{.intercept = toml.model.intercept};
  take_row(toml.model.weights, "model.weights", source.file, model.weights);
  take_row(toml.model.means, "model.means", source.file, model.means);
  take_row(toml.model.scales, "model.scales", source.file, model.scales);
  model.decision = decision_of(toml.decision, source.file);
  return {model, toml.training, toml.held_out};
}

std::string to_toml_text(const LearnedModelFile& file) {
  LearnedToml toml{{}, columns_of(file.model.decision), file.training, file.held_out};
  const LearnedModel& model = file.model;
  toml.model.intercept = model.intercept;
  toml.model.weights.assign(model.weights.begin(), model.weights.end());
  toml.model.means.assign(model.means.begin(), model.means.end());
  toml.model.scales.assign(model.scales.begin(), model.scales.end());
  return to_toml(toml);
}

}  // namespace trivela::config
