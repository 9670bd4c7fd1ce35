#include "robot/decision/keeper_habit.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/geometry/time.hpp"

namespace trivela::robot {
namespace {

// Assumptions.
constexpr double kHead_s = 0.13;         // that one which jumps has driven more than the reaction, when it is looked at
constexpr double kTrackAge_s = 0.17;     // of what a track shows of somebody who moves: camera and filter
constexpr double kLate_s = 0.05;         // a cycle that comes later tells nothing
constexpr double kInSight_m = 0.1;       // a track that is less certain has no picture of the last 0.2 s
constexpr double kFollow_ratio = 0.3;    // of the keepers that do not guess
constexpr double kChange_ratio = 0.01;   // that from this kick on it plays as anybody may
constexpr double kOutlier_ratio = 0.01;  // of a likelihood's peak, whatever is seen

}  // namespace

KeeperHabit::KeeperHabit(const kicking::KeeperConfig& keeper)
    : look_s_(keeper.reaction_s + kHead_s + kTrackAge_s),
      jump_m_(0.5 * keeper.acceleration_mps2 * (keeper.reaction_s + kHead_s) * (keeper.reaction_s + kHead_s)),
      prior_{(1.0 - kFollow_ratio) * (1.0 - keeper.guess_prior), kFollow_ratio * (1.0 - keeper.guess_prior),
             keeper.guess_prior},
      p_(prior_) {}

void KeeperHabit::see(std::int64_t t_ns, const std::optional<kicking::KeeperPlace>& keeper) {
  if (!kick_) return;
  const double since_s = kicking::seconds(t_ns - kick_->release_t_ns);
  if (since_s < 0.0) return;
  const double due_s = kick_->stood ? look_s_ : 0.0;
  if (since_s < due_s) return;
  if (!keeper || !std::isfinite(keeper->x_m) || !(keeper->sd_m <= kInSight_m) || since_s > due_s + kLate_s)
    return forget_kick();
  if (!kick_->stood) {
    kick_->stood = keeper;
    return;
  }
  // Errors of one track are alike: half the sum.
  const double var_m2 = std::max(1e-9, 0.5 * (keeper->sd_m * keeper->sd_m + kick_->stood->sd_m * kick_->stood->sd_m));
  learn(keeper->x_m - kick_->stood->x_m, kick_->x_cross_m - kick_->stood->x_m, var_m2);
  forget_kick();
}

void KeeperHabit::learn(double gone_m, double way_m, double var_m2) {
  const auto likelihood = [&](double mean_m) {
    return std::exp(-0.5 * (gone_m - mean_m) * (gone_m - mean_m) / var_m2);
  };
  double follows = 0.0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) follows += 0.25 * likelihood(share * way_m);
  const std::array<double, 3> seen{likelihood(0.0), follows, 0.5 * (likelihood(jump_m_) + likelihood(-jump_m_))};
  double sum = 0.0;
  for (std::size_t i = 0; i < p_.size(); ++i) sum += p_[i] *= seen[i] + kOutlier_ratio;
  for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = (1.0 - kChange_ratio) * p_[i] / sum + kChange_ratio * prior_[i];
}

}  // namespace trivela::robot
