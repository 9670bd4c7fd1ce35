#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

namespace trivela::kicking {

/// What the speeds of a table are. Effective: of the drag-free parabola through apex height and range of a real lob
/// (paper, section 2.2; drag is absorbed). True: of the ball at the release (a fit with drag). A drag-free law needs
/// the effective table, a law with drag the true one; mixed up, the ball is 0.2 to 0.7 m off in height. They are two
/// types.
enum class TableKind { kEffective, kTrue };

/// One calibrated power and the exit speed that it gives.
struct SetPoint {
  double power = 0.0;
  double speed_mps = 0.0;
};

enum class PowerRange { kBelow, kIn, kAbove };

/// A power and whether the wanted speed lay within the table; outside it the power is that of the nearer end.
struct PowerReading {
  double power = 0.0;
  PowerRange range = PowerRange::kIn;
};

/// Exit speed over kick power, linear between set-points and clamped at the ends (paper, section 2.2). The power is
/// fractional: the released code truncates it to an integer, which costs 0.09 m/s on average. Storage is fixed: no use
/// of it allocates.
template <TableKind kind>
class PowerTable {
 public:
  static constexpr std::size_t kCapacity = 256;
  static constexpr TableKind kKind = kind;

  /// Two to kCapacity set-points, finite, positive, both columns strictly increasing.
  /// Throws std::invalid_argument naming the index and the value.
  explicit PowerTable(std::span<const SetPoint> set_points) : size_(set_points.size()) {
    if (size_ < 2 || size_ > kCapacity) {
      throw std::invalid_argument("power table: " + std::to_string(size_) + " set-points, need 2 to " +
                                  std::to_string(kCapacity) +
                                  (size_ > kCapacity ? ": leave some out, it is linear between neighbours" : ""));
    }
    std::copy(set_points.begin(), set_points.end(), set_points_.begin());
    for (std::size_t i = 0; i < size_; ++i) {
      check("power", i, &SetPoint::power);
      check("speed_mps", i, &SetPoint::speed_mps);
    }
  }
  PowerTable(std::initializer_list<SetPoint> set_points)
      : PowerTable(std::span<const SetPoint>(set_points.begin(), set_points.size())) {}

  /// Power for an exit speed [m/s].
  PowerReading power_for(double speed_mps) const {
    if (speed_mps <= front().speed_mps) return {front().power, PowerRange::kBelow};
    if (speed_mps >= back().speed_mps) return {back().power, PowerRange::kAbove};
    return {interpolate(speed_mps, &SetPoint::speed_mps, &SetPoint::power), PowerRange::kIn};
  }

  /// Exit speed [m/s] at a power, clamped to the table.
  double speed_for(double power) const {
    return interpolate(std::clamp(power, front().power, back().power), &SetPoint::power, &SetPoint::speed_mps);
  }

  std::span<const SetPoint> set_points() const { return {set_points_.data(), size_}; }
  const SetPoint& front() const { return set_points_[0]; }
  const SetPoint& back() const { return set_points_[size_ - 1]; }

 private:
  using Column = double SetPoint::*;

  void check(const char* name, std::size_t i, Column column) const {
    const double value = set_points_[i].*column;
    const bool first = i == 0;
    if (std::isfinite(value) && value > (first ? 0.0 : set_points_[i - 1].*column)) return;
    throw std::invalid_argument("power table: " + std::string(name) + "[" + std::to_string(i) +
                                "] = " + std::to_string(value) + " must be finite and above " +
                                (first ? "0" : "its predecessor " + std::to_string(set_points_[i - 1].*column)));
  }

  double interpolate(double value, Column from, Column to) const {
    std::size_t high = 1;
    while (high + 1 < size_ && set_points_[high].*from < value) ++high;
    const SetPoint& a = set_points_[high - 1];
    const SetPoint& b = set_points_[high];
    return a.*to + (b.*to - a.*to) * (value - a.*from) / (b.*from - a.*from);
  }

  std::array<SetPoint, kCapacity> set_points_{};
  std::size_t size_ = 0;
};

using EffectiveTable = PowerTable<TableKind::kEffective>;
using TrueTable = PowerTable<TableKind::kTrue>;

/// Exit angle of one calibrated power.
struct AnglePoint {
  double power = 0.0;
  double exit_angle_rad = 0.0;
};

/// Exit angle over kick power, linear between set-points and clamped at the ends. It is for kickers whose angle is not
/// constant, as the paper takes it; published tables run from 30 to 48 degrees. Storage is fixed: no use of it
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
