#pragma once

#include <map>
#include <string>
#include <utility>

#include "evaluator/page/figures/figure.hpp"

namespace trivela::evaluator::page {

/// Counts of points in square cells, where there are too many points to draw.
class HeatMap {
 public:
  explicit HeatMap(double cell_m) : cell_m_(cell_m) {}

  void add(double x_m, double y_m);

  /// Cells as squares of class `kind`, the fuller the less transparent; y upwards by `y`.
  std::string draw(const std::string& kind, const Scale& x, const Scale& y) const;

  std::size_t fullest() const;

 private:
  double cell_m_;
  std::map<std::pair<long, long>, std::size_t> cells_;
};

}  // namespace trivela::evaluator::page
