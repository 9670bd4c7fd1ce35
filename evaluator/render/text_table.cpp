#include "evaluator/render/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kicking/text/printable.hpp"

namespace trivela::evaluator {

std::string text_table(const std::vector<std::vector<std::string>>& rows) {
  auto cells = rows;
  std::vector<std::size_t> widths;
  for (auto& row : cells) {
    for (std::string& cell : row) cell = kicking::printable(cell);
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : cells) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += i == 0 ? fmt::format("  {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    text += "\n";
  }
  return text;
}

std::string percent(double fraction) { return fmt::format("{:.1f} %", 100.0 * fraction); }

std::string percent(stats::Interval fractions) {
  return fmt::format("{} to {}", percent(fractions.lo), percent(fractions.hi));
}

std::string words(std::string label) {
  std::ranges::replace(label, '_', ' ');
  return label;
}

}  // namespace trivela::evaluator
