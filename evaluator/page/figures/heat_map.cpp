#include "evaluator/page/figures/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/page/html.hpp"

namespace trivela::evaluator::page {

void HeatMap::add(double x_m, double y_m) {
  ++cells_[{std::lround(std::floor(x_m / cell_m_)), std::lround(std::floor(y_m / cell_m_))}];
}

std::size_t HeatMap::fullest() const {
  std::size_t most = 0;
  for (const auto& [cell, n] : cells_) most = std::max(most, n);
  return most;
}

std::string HeatMap::draw(const std::string& kind, const Scale& x, const Scale& y) const {
  const auto most = static_cast<double>(fullest());
  std::string svg;
  for (const auto& [cell, n] : cells_) {
    const double left = cell_m_ * static_cast<double>(cell.first);
    const double low = cell_m_ * static_cast<double>(cell.second);
    const double width = x.length_px(cell_m_), height = -y.length_px(cell_m_);
    const double share = std::sqrt(static_cast<double>(n) / most);
    svg += titled(counted(static_cast<std::int64_t>(n), "kick", "kicks"),
                  fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                              "fill-opacity=\"{:.2f}\"/>",
                              kind, x.px(left), y.px(low + cell_m_), width, height, 0.12 + 0.88 * share));
  }
  return svg;
}

}  // namespace trivela::evaluator::page
