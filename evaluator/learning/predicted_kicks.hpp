#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

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

}  // namespace trivela::evaluator
