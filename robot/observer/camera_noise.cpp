#include "robot/observer/camera_noise.hpp"

#include <cmath>
#include <vector>

#include "kicking/estimate.hpp"

namespace trivela::robot {
namespace {

constexpr double kConfiguredWeight = 4.0;
constexpr double kMostWeight = 100.0;
constexpr double kWeightOfATriplet = 0.5;  // a median of two overlapping differences knows about half of it
constexpr double kMedianOfNormal = 0.6744897501960817;

}  // namespace

CameraNoise::CameraNoise(double configured_sd_m) : configured_m2_(configured_sd_m * configured_sd_m) {}

void CameraNoise::learn(std::span<const kicking::Sighting> sightings) {
  if (sightings.size() < 3) return;
  std::vector<double> off_m;
  off_m.reserve(2 * (sightings.size() - 2));
  for (std::size_t i = 1; i + 1 < sightings.size(); ++i) {
    const kicking::Sighting &a = sightings[i - 1], &b = sightings[i], &c = sightings[i + 1];
    if (a.t_ns >= c.t_ns) continue;
    const double w = static_cast<double>(b.t_ns - a.t_ns) / static_cast<double>(c.t_ns - a.t_ns);
    const double scale = 1.0 / std::sqrt(1.0 + (1.0 - w) * (1.0 - w) + w * w);
    for (const int axis : {0, 1})
      off_m.push_back(scale * std::abs(b.ball_m[axis] - (1.0 - w) * a.ball_m[axis] - w * c.ball_m[axis]));
  }
  if (off_m.empty()) return;
  const double sd_m = kicking::upper_median(std::span(off_m)) / kMedianOfNormal;
  const double weight = kWeightOfATriplet * 0.5 * static_cast<double>(off_m.size());
  learned_m2_ += weight * sd_m * sd_m;
  weight_ += weight;
  if (weight_ > kMostWeight) {
    learned_m2_ *= kMostWeight / weight_;
    weight_ = kMostWeight;
  }
}

double CameraNoise::sd_m() const {
  return std::sqrt((kConfiguredWeight * configured_m2_ + learned_m2_) / (kConfiguredWeight + weight_));
}

}  // namespace trivela::robot
