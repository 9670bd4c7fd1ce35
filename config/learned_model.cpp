#include "config/learned_model.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::kicking {

template <class V>
void fields(V& v, DriveStyle& s) {
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

template <class V>
void fields(V& v, ModelColumns& m) {
  v("features", m.features);
  v("intercept", m.intercept, kAny);
  v("weights", m.weights, kAny);
  v("means", m.means, kAny);
  v("scales", m.scales, Range{1e-9, 1e6});
}

template <class V>
void fields(V& v, DecisionColumns& d) {
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

template <class V>
void fields(V& v, TrainingOrigin& t) {
  v("source", t.source);
  v("date", t.date);
  v("files", t.files);
  v("matches", t.matches, kNotNegative);
  v("kicks", t.kicks, kNotNegative);
  v("ridge", t.ridge, kNotNegative);
}

template <class V>
void fields(V& v, HeldOut& h) {
  v("matches", h.matches, kNotNegative);
  v("kicks", h.kicks, kNotNegative);
  v("log_loss_learned", h.log_loss_learned, kNotNegative);
  v("log_loss_predictive", h.log_loss_predictive, kNotNegative);
  v("difference", h.difference, kAny);
  v("difference_low", h.difference_low, kAny);
  v("difference_high", h.difference_high, kAny);
  v("better", h.better);
}

template <class V>
void fields(V& v, LearnedToml& f) {
  v("model", f.model);
  v("decision", f.decision);
  v("training", f.training);
  v("held_out", f.held_out);
}

namespace {

LearnedModel::Row row_of(const std::vector<double>& column, const char* key, const std::string& file) {
  LearnedModel::Row row{};
  if (column.size() != row.size()) {
    throw Error{fmt::format("{}: model.{} has {} entries, need one for each of the {} features", file, key,
                            column.size(), row.size())};
  }
  std::ranges::copy(column, row.begin());
  return row;
}

LearnedDecision decision_of(const DecisionColumns& read, const std::string& file) {
  if (!std::ranges::equal(read.fire_features, kicking::kFireFeatureNames)) {
    throw Error{fmt::format("{}: decision.fire_features are not those of this program: {}", file,
                            fmt::join(kicking::kFireFeatureNames, ", "))};
  }
  LearnedDecision decision = read.numbers;
  if (read.fire_weights.size() != decision.fire_weights.size()) {
    throw Error{fmt::format("{}: decision.fire_weights has {} entries, need one for each of the {} features", file,
                            read.fire_weights.size(), decision.fire_weights.size())};
  }
  std::ranges::copy(read.fire_weights, decision.fire_weights.begin());
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

std::vector<double> column_of(const LearnedModel::Row& row) { return {row.begin(), row.end()}; }

}  // namespace

LearnedModelFile load_learned_model(const std::filesystem::path& path) {
  LearnedToml toml;
  const TomlSource source = parse_file(path);
  read_into(source, toml);
  if (!std::ranges::equal(toml.model.features, LearnedModel::kFeatureNames)) {
    throw Error{fmt::format("{}: model.features are not those of this program: {}", source.file,
                            fmt::join(LearnedModel::kFeatureNames, ", "))};
  }
  return {{.intercept = toml.model.intercept,
           .weights = row_of(toml.model.weights, "weights", source.file),
           .means = row_of(toml.model.means, "means", source.file),
           .scales = row_of(toml.model.scales, "scales", source.file),
           .decision = decision_of(toml.decision, source.file)},
          toml.training,
          toml.held_out};
}

std::string to_toml_text(const LearnedModelFile& file) {
  LearnedToml toml{{}, columns_of(file.model.decision), file.training, file.held_out};
  toml.model.intercept = file.model.intercept;
  toml.model.weights = column_of(file.model.weights);
  toml.model.means = column_of(file.model.means);
  toml.model.scales = column_of(file.model.scales);
  return to_toml(toml);
}

}  // namespace trivela::config
