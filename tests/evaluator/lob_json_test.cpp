#include "evaluator/render/lob_json.hpp"

#include <gtest/gtest.h>

namespace trivela::evaluator {
namespace {

kicking::lob::LobRecord seen_lob() {
  kicking::lob::LobRecord lob;
  lob.effective.emplace();
  lob.effective->exit_angle_rad = {0.6, 0.01};
  lob.effective->height_m = {1.2, 0.1};
  return lob;
}

TEST(LobJson, WritesEstimatesInThreeForms) {
  const auto lob = seen_lob();
  const Json value = effective_json(lob, EstimateForm::kValue);
  EXPECT_EQ(value["height_m"], 1.2);
  EXPECT_EQ(value.size(), 4u);
  const Json beside = effective_json(lob, EstimateForm::kBeside);
  EXPECT_EQ(beside["height_m"], 1.2);
  EXPECT_EQ(beside["height_m_se"], 0.1);
  EXPECT_EQ(beside.size(), 8u);
  EXPECT_EQ(effective_json(lob, EstimateForm::kObject)["height_m"], (Json{{"value", 1.2}, {"se", 0.1}}));
}

TEST(LobJson, WritesAnglesInDegrees) {
  EXPECT_NEAR(effective_json(seen_lob(), EstimateForm::kValue)["exit_angle_deg"].get<double>(), 34.377468, 1e-6);
  EXPECT_NEAR(effective_json(seen_lob(), EstimateForm::kBeside)["exit_angle_deg_se"].get<double>(), 0.572958, 1e-6);
}

TEST(LobJson, IsNullWithoutAFit) {
  EXPECT_TRUE(true_json(seen_lob(), EstimateForm::kObject).is_null());
  EXPECT_TRUE(effective_json({}, EstimateForm::kValue).is_null());
}

}  // namespace
}  // namespace trivela::evaluator
