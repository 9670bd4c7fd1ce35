#pragma once

#include <span>
#include <vector>

namespace trivela::kicking {

/// Speed of a set-point and the number of trials behind it.
struct WeightedSpeed {
  double speed_mps = 0.0;
  double weight = 1.0;
};

/// The strictly rising speeds nearest to the given ones [m/s]: isotonic least squares by pooling adjacent violators
/// (Barlow et al. 1972), then the members of a pool 2 mm/s from one to the next around its mean, less where the next
/// pool is nearer. Speeds that rise by 2 mm/s or more come back unchanged.
std::vector<double> rising_speeds(std::span<const WeightedSpeed> speeds);

}  // namespace trivela::kicking
