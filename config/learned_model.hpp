#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/text/field_types.hpp"
#include "kicking/policy/learned_model.hpp"

namespace trivela::config {

/// What a learned model was trained on.
struct TrainingOrigin {
  std::string source;              ///< the command that wrote the file
  std::string date;                ///< ISO 8601, YYYY-MM-DD
  std::vector<std::string> files;  ///< names of the logs
  std::uint32_t matches = 0;
  std::uint32_t kicks = 0;
  double ridge = 0.0;  ///< penalty on the squared weights, chosen by cross-validation
};

/// How the model did on matches that its fit did not see. Log losses are means over kicks, in nats.
struct HeldOut {
  std::uint32_t matches = 0;
  std::uint32_t kicks = 0;
  double log_loss_learned = 0.0;
  double log_loss_predictive = 0.0;
  double difference = 0.0;  ///< learned - predictive; negative: the model is better
  double difference_low = 0.0;
  double difference_high = 0.0;  ///< 95 % interval, matches as clusters
  bool better = false;           ///< the interval lies below 0
};

/// A learned model with its provenance: config/learned.toml.
struct LearnedModelFile {
  kicking::LearnedModel model;
  TrainingOrigin training;
  HeldOut held_out;
};

/// Reads a file of `trivela study learn`. Throws Error naming file, line and key: also for a list that has not one
/// number for each feature, features of other names or another order, and a scale of 0.
LearnedModelFile load_learned_model(const std::filesystem::path& path);

/// The file as TOML that load_learned_model() reads back.
std::string to_toml_text(const LearnedModelFile& file);

}  // namespace trivela::config
