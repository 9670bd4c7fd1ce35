#include "config/learned_model.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::config {

using kicking::LearnedModel;

/// [model] as the file has it.
struct ModelColumns {
  std::vector<std::string> features{LearnedModel::kFeatureNames.begin(), LearnedModel::kFeatureNames.end()};
  double intercept = 0.0;
  std::vector<double> weights, means, scales;
};

struct LearnedToml {
  ModelColumns model;
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
           .scales = row_of(toml.model.scales, "scales", source.file)},
          toml.training,
          toml.held_out};
}

std::string to_toml_text(const LearnedModelFile& file) {
  LearnedToml toml{{}, file.training, file.held_out};
  toml.model.intercept = file.model.intercept;
  toml.model.weights = column_of(file.model.weights);
  toml.model.means = column_of(file.model.means);
  toml.model.scales = column_of(file.model.scales);
  return to_toml(toml);
}

}  // namespace trivela::config
