#include "experiment/factorial/design.hpp"

#include <fmt/core.h>

namespace trivela::experiment {

using kicking::PolicyName;

const char* name(Law law) {
  switch (law) {
    case Law::kPaper:
      return "paper";
    case Law::kReleased:
      return "released";
    case Law::kExact:
      break;
  }
  return "exact";
}

std::string Cell::name() const {
  const std::string words = fmt::format("{} {}", table, kicking::name(policy));
  return policy == PolicyName::kPredictive ? words : fmt::format("{} {}", words, experiment::name(law));
}

std::vector<Cell> factorial_cells() {
  std::vector<Cell> cells;
  for (const char* table : {"old", "new"}) {
    for (const PolicyName policy : {PolicyName::kStopped, PolicyName::kMoving}) {
      for (const Law law : {Law::kPaper, Law::kReleased, Law::kExact}) cells.push_back({table, policy, law});
    }
    cells.push_back({table, PolicyName::kPredictive, Law::kExact});
  }
  return cells;
}

Arm arm_of(const Cell& cell, const config::Settings& settings, const std::vector<config::Robot>& robots) {
  Arm arm{.name = cell.name(),
          .policy = cell.policy,
          .table = cell.table,
          .settings = settings,
          .robots = robots,
          .random = {}};
  kicking::PolicyConfig& policy = arm.settings.policy;
  policy.motion_law = cell.law == Law::kExact ? kicking::MotionLaw::kExact : kicking::MotionLaw::kPaper;
  policy.height_law = cell.law == Law::kPaper      ? kicking::HeightLaw::kPaper
                      : cell.law == Law::kReleased ? kicking::HeightLaw::kExtendedRange
                                                   : kicking::HeightLaw::kExact;
  policy.alpha_law = kicking::AlphaLaw::kPaperLine;
  return arm;
}

}  // namespace trivela::experiment
