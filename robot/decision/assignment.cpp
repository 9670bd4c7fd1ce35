#include "robot/decision/assignment.hpp"

#include <algorithm>

#include "kicking/random/draws.hpp"

namespace trivela::robot {
namespace {

constexpr std::uint32_t kPurpose = 0x41535347;  // where the simulator's numbers have their role, and none has this one

double uniform(std::uint64_t seed, std::uint8_t robot_id, std::uint8_t half, std::uint32_t possession_id) {
  const auto words = kicking::philox4x32({possession_id, half, kPurpose, robot_id},
                                         {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  const std::uint64_t bits = (std::uint64_t{words[0]} << 32 | words[1]) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace

PolicyAssignment::PolicyAssignment(const config::KickDecision& settings, std::uint8_t robot_id)
    : by_half_(settings.policy_by_half), seed_(settings.assignment_seed), robot_id_(robot_id) {
  config::check_policies(settings, "settings");
  const auto& by_robot = settings.policy_by_robot;
  if (robot_id >= 1 && robot_id <= by_robot.size()) by_half_ = {by_robot[robot_id - 1u]};
  const auto& probabilities = settings.random_probabilities;
  for (std::size_t i = 0; i < settings.random.size(); ++i) {
    const double alike = 1.0 / static_cast<double>(settings.random.size());
    random_.push_back({settings.random[i], probabilities.empty() ? alike : probabilities[i]});
  }
}

PolicyChance PolicyAssignment::in_charge(std::uint8_t half, std::uint32_t possession_id) const {
  if (random_.empty()) return {by_half_[std::clamp<std::size_t>(half, 1, by_half_.size()) - 1], 1.0};
  double u = uniform(seed_, robot_id_, half, possession_id);
  const PolicyChance* drawn = nullptr;
  for (const PolicyChance& chance : random_) {
    if (chance.probability <= 0.0) continue;  // rounding must not choose it
    drawn = &chance;
    if (u < chance.probability) break;
    u -= chance.probability;
  }
  return *drawn;
}

std::vector<kicking::PolicyName> PolicyAssignment::candidates() const {
  if (random_.empty()) return by_half_;
  std::vector<kicking::PolicyName> names;
  for (const PolicyChance& chance : random_) names.push_back(chance.policy);
  return names;
}

}  // namespace trivela::robot
