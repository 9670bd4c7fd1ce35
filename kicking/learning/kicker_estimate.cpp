#include "kicking/learning/kicker_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace trivela::kicking {
namespace {

constexpr double kMost_ln = 0.5, kMostTransfer = 1.5, kLongestDelay_s = 0.5;
constexpr double kFlattest_rad = radians(5.0), kSteepest_rad = radians(80.0);
constexpr double kMostTurned_rad = radians(20.0);
constexpr double kPaperPerExact = 0.7;  // k of kicker.map against the exact law's full transfer

double elevation(double file_rad, double by_rad) {
  return std::clamp(file_rad + by_rad, std::min(file_rad, kFlattest_rad), kSteepest_rad);
}

double share(double file, double by) { return std::clamp(file + by, 0.0, kMostTransfer); }

EffectiveTable faster(const EffectiveTable& file, double factor) {
  std::array<SetPoint, EffectiveTable::kCapacity> points{};
  const auto from = file.set_points();
  std::ranges::transform(from, points.begin(), [factor](const SetPoint& point) {
    return SetPoint{point.power, factor * point.speed_mps};
  });
  return EffectiveTable{std::span<const SetPoint>(points.data(), from.size())};
}

AngleTable steeper(const AngleTable& file, double by_rad) {
  std::array<AnglePoint, AngleTable::kCapacity> points{};
  const auto from = file.points();
  std::ranges::transform(from, points.begin(), [by_rad](const AnglePoint& point) {
    return AnglePoint{point.power, elevation(point.exit_angle_rad, by_rad)};
  });
  return AngleTable{std::span<const AnglePoint>(points.data(), from.size())};
}

}  // namespace

bool valid(const KickerEstimate& estimate) {
  const double spreads[] = {estimate.speed_sd_ratio, estimate.elevation_sd_rad, estimate.direction_sd_rad,
                            estimate.delay_sd_s};
  constexpr double kMost = 2.0;
  return (estimate.mean.array().abs() <= kMost).all() && (estimate.se.array() >= 0.0).all() &&
         (estimate.se.array() <= kMost).all() &&
         std::ranges::all_of(spreads, [](double sd) { return sd >= 0.0 && sd <= kMost; });
}

RobotModel corrected(const RobotModel& file, const KickerEstimate& estimate) {
  const KickerVector& mean = estimate.mean;
  const KickerVector& se = estimate.se;
  const double factor = std::exp(std::clamp(mean[kSpeedPart], -kMost_ln, kMost_ln));
  RobotModel model = file;
  model.table = faster(file.table, factor);
  model.exit_angle_rad = elevation(file.exit_angle_rad, mean[kElevationPart]);
  if (file.exit_angles) model.exit_angles = steeper(*file.exit_angles, mean[kElevationPart]);
  model.direction_rad = std::clamp(file.direction_rad + mean[kDirectionPart], -kMostTurned_rad, kMostTurned_rad);
  model.delay_s = std::clamp(file.delay_s + mean[kDelayPart], 0.0, kLongestDelay_s);
  const double along = mean[kAlongPart], sideways = mean[kSidewaysPart];
  model.transfer_exact = {share(file.transfer_exact.forward, along), share(file.transfer_exact.backward, along),
                          share(file.transfer_exact.lateral, sideways)};
  model.transfer_paper.forward = share(file.transfer_paper.forward, kPaperPerExact * along);
  model.transfer_paper.backward = share(file.transfer_paper.backward, kPaperPerExact * along);
  const double middle_power = 0.5 * (file.table.front().power + file.table.back().power);
  const double over_floor_mps = model.table.speed_for(middle_power) * std::cos(model.exit_angle_at(middle_power));
  model.alpha_slope_rad_per_mps = file.alpha_slope_rad_per_mps / factor + sideways / over_floor_mps;
  model.beta_slope_s =
      std::max(0.0, file.beta_slope_s + model.delay_s - file.delay_s + sideways * file.ball_offset_m / over_floor_mps);
  KickSpreads& spreads = model.spreads;
  spreads.speed_sd_ratio = estimate.speed_sd_ratio;
  spreads.table_sd_ratio = se[kSpeedPart];
  spreads.exit_angle_sd_rad = std::hypot(estimate.elevation_sd_rad, se[kElevationPart]);
  spreads.direction_sd_rad = std::hypot(estimate.direction_sd_rad, se[kDirectionPart]);
  spreads.delay_sd_s = std::hypot(estimate.delay_sd_s, se[kDelayPart]);
  spreads.transfer_sd_ratio = std::max(se[kAlongPart], se[kSidewaysPart]);
  spreads.exit_angle_se_rad = spreads.direction_se_rad = spreads.delay_se_s = 0.0;
  // One coil drives every kind, and its ball lies in the same handler; angle and direction are of the lever's position.
  for (RobotModel& further : model.further_kinds) {
    further.table = faster(further.table, factor);
    further.delay_s = std::clamp(further.delay_s + mean[kDelayPart], 0.0, kLongestDelay_s);
    further.transfer_exact = model.transfer_exact;
  }
  return model;
}

}  // namespace trivela::kicking
