#include "hal/replay/row_pages.hpp"

#include <fmt/format.h>

#include <utility>

namespace trivela::hal {

constexpr int kPageRows = 1024;

std::optional<double> ReplayRow::number(std::size_t column) const {
  const auto& cell = cells_.at(column);
  if (std::holds_alternative<std::monostate>(cell)) return std::nullopt;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
  return std::get<double>(cell);
}

RowPages::RowPages(ReplayLog log, std::string table, const std::vector<std::string>& columns)
    : log_(std::move(log)), table_(std::move(table)), columns_(fmt::format("{}", fmt::join(columns, ", "))) {
  fill();
}

std::optional<ReplayRow> RowPages::next() {
  if (page_.empty()) return std::nullopt;
  ReplayRow row = std::move(page_.front());
  page_.pop_front();
  if (page_.empty()) fill();
  return row;
}

void RowPages::fill() {
  const auto sql =
      fmt::format("SELECT seq, {} FROM {} WHERE session_id = {} AND robot_id = {} AND seq > {} ORDER BY seq LIMIT {}",
                  columns_, table_, log_.session_id, log_.robot_id, after_seq_, kPageRows);
  log_.reader->query(sql, [this](std::span<const evaluator::log::Value> cells) {
    after_seq_ = std::get<std::int64_t>(cells.front());
    page_.emplace_back(std::vector(cells.begin() + 1, cells.end()));
  });
}

}  // namespace trivela::hal
