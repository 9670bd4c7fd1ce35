#include "evaluator/render/lob_json.hpp"

#include "kicking/geometry/angle.hpp"

namespace trivela::evaluator {
namespace {

using kicking::Estimate;
using kicking::lob::LobRecord;

void put(Json& object, const std::string& key, const Estimate& estimate, EstimateForm form) {
  object[key] =
      form == EstimateForm::kObject ? Json{{"value", estimate.value}, {"se", estimate.se}} : Json(estimate.value);
  if (form == EstimateForm::kBeside) object[key + "_se"] = estimate.se;
}

Estimate in_degrees(const Estimate& angle_rad, EstimateForm form) {
  if (form == EstimateForm::kValue) return {kicking::degrees(angle_rad.value), kicking::degrees(angle_rad.se)};
  const double unit = kicking::degrees(1.0);  // differs in the last digit, which readers may compare
  return {angle_rad.value * unit, angle_rad.se * unit};
}

}  // namespace

Json verdict_json(const LobRecord& lob) {
  return {{"accepted", lob.refusal == kicking::lob::Refusal::kNone},
          {"refusal", kicking::lob::name(lob.refusal)},
          {"why", lob.why}};
}

Json effective_json(const LobRecord& lob, EstimateForm form) {
  Json json;
  if (!lob.effective) return json;
  put(json, "exit_angle_deg", in_degrees(lob.effective->exit_angle_rad, form), form);
  put(json, "exit_speed_mps", lob.effective->exit_speed_mps, form);
  put(json, "height_m", lob.effective->height_m, form);
  put(json, "distance_m", lob.effective->distance_m, form);
  return json;
}

Json true_json(const LobRecord& lob, EstimateForm form) {
  Json json;
  if (!lob.true_values) return json;
  put(json, "exit_angle_deg", in_degrees(lob.true_values->exit_angle_rad, form), form);
  put(json, "exit_speed_mps", lob.true_values->exit_speed_mps, form);
  put(json, "Cd", lob.true_values->drag_coefficient, form);
  return json;
}

}  // namespace trivela::evaluator
