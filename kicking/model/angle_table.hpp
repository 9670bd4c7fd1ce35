#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "kicking/model/power_table.hpp"

namespace trivela::kicking {

/// Exit angle of one calibrated power.
struct AnglePoint {
  double power = 0.0;
  double exit_angle_rad = 0.0;
};

/// Exit angle over kick power, linear between set-points and clamped at the ends, for kickers whose angle is not
/// constant as the paper takes it (published tables run from 30 to 48 degrees). Storage is fixed: no use of it
/// allocates.
class AngleTable {
 public:
  static constexpr std::size_t kCapacity = EffectiveTable::kCapacity;

  /// Two to kCapacity points, powers positive and strictly increasing, angles between 0 and 90 degrees.
  /// Throws std::invalid_argument naming the index and the value.
  explicit AngleTable(std::span<const AnglePoint> points) : size_(points.size()) {
    if (size_ < 2 || size_ > kCapacity) {
      throw std::invalid_argument("angle table: " + std::to_string(size_) + " set-points, need 2 to " +
                                  std::to_string(kCapacity) +
                                  (size_ > kCapacity ? ": leave some out, it is linear between neighbours" : ""));
    }
    std::copy(points.begin(), points.end(), points_.begin());
    for (std::size_t i = 0; i < size_; ++i) check(i);
  }

  /// Exit angle at a power [rad].
  double angle_for(double power) const {
    const double clamped = std::clamp(power, points_[0].power, points_[size_ - 1].power);
    std::size_t high = 1;
    while (high + 1 < size_ && points_[high].power < clamped) ++high;
    const AnglePoint& a = points_[high - 1];
    const AnglePoint& b = points_[high];
    return a.exit_angle_rad + (b.exit_angle_rad - a.exit_angle_rad) * (clamped - a.power) / (b.power - a.power);
  }

  std::span<const AnglePoint> points() const { return {points_.data(), size_}; }

 private:
  void check(std::size_t i) const {
    const AnglePoint& point = points_[i];
    const auto fail = [i](const char* name, double value, const std::string& rule) {
      throw std::invalid_argument("angle table: " + std::string(name) + "[" + std::to_string(i) +
                                  "] = " + std::to_string(value) + " must be " + rule);
    };
    if (!(std::isfinite(point.power) && point.power > (i == 0 ? 0.0 : points_[i - 1].power))) {
      fail("power", point.power, i == 0 ? "above 0" : "above its predecessor");
    }
    if (!(point.exit_angle_rad > 0.0 && point.exit_angle_rad < 0.5 * std::numbers::pi)) {
      fail("exit_angle_rad", point.exit_angle_rad, "between 0 and pi / 2");
    }
  }

  std::array<AnglePoint, kCapacity> points_{};
  std::size_t size_ = 0;
};

}  // namespace trivela::kicking
