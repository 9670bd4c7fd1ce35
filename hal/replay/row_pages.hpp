#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "hal/replay/replay_log.hpp"

namespace trivela::hal {

/// One recorded row, its cells in the order of the columns asked for.
class ReplayRow {
 public:
  explicit ReplayRow(std::vector<evaluator::log::Value> cells) : cells_(std::move(cells)) {}

  std::int64_t integer(std::size_t column) const { return std::get<std::int64_t>(cells_.at(column)); }
  bool boolean(std::size_t column) const { return integer(column) != 0; }
  const std::string& text(std::size_t column) const { return std::get<std::string>(cells_.at(column)); }
  /// None: NULL, there is no such quantity.
  std::optional<double> number(std::size_t column) const;

 private:
  std::vector<evaluator::log::Value> cells_;
};

/// The rows of one table in the order of seq, read a page at a time: a log may be larger than memory.
class RowPages {
 public:
  /// `table` must have the columns session_id, robot_id and seq. Throws std::runtime_error where it has not.
  RowPages(ReplayLog log, std::string table, const std::vector<std::string>& columns);

  /// The next row without taking it; null at the end.
  const ReplayRow* peek() const { return page_.empty() ? nullptr : &page_.front(); }

  /// Takes the next row.
  std::optional<ReplayRow> next();

 private:
  void fill();

  ReplayLog log_;
  std::string table_;
  std::string columns_;
  std::int64_t after_seq_ = -1;
  std::deque<ReplayRow> page_;
};

}  // namespace trivela::hal
