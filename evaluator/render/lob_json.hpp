#pragma once

#include "evaluator/render/json_values.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::evaluator {

/// How the estimates of a lob are written.
enum class EstimateForm {
  kValue,   ///< "height_m": 1.2
  kBeside,  ///< "height_m": 1.2, "height_m_se": 0.1
  kObject,  ///< "height_m": {"value": 1.2, "se": 0.1}
};

/// "accepted", "refusal" and "why" of a lob.
Json verdict_json(const kicking::lob::LobRecord& lob);

/// "exit_angle_deg", "exit_speed_mps", "height_m" and "distance_m" of the effective fit; null without one.
Json effective_json(const kicking::lob::LobRecord& lob, EstimateForm form);

/// "exit_angle_deg", "exit_speed_mps" and "Cd" of the fit with drag; null without one.
Json true_json(const kicking::lob::LobRecord& lob, EstimateForm form);

}  // namespace trivela::evaluator
