#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "evaluator/log/row.hpp"
#include "hal/replay/replay_log.hpp"
#include "idl/meta.hpp"
#include "idl/none.hpp"

namespace trivela::hal {

/// The message whose columns_of<T>() a row holds; NaN for a number that is NULL. Throws WrongCell.
template <bus::Message T>
T message_of(std::span<const evaluator::log::Value> cells) {
  using evaluator::log::cell_as;
  T message{};
  std::size_t column = 0;
  bus::visit_columns(message, [&](std::string_view, auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (bus::Enumeration<Field>) {
      const auto value = bus::from_label<Field>(cell_as<std::string>(cells[column], column));
      if (!value) throw evaluator::log::WrongCell{column, "a label of its enum"};
      field = *value;
    } else if constexpr (std::is_floating_point_v<Field>) {
      field = cell_as<std::optional<Field>>(cells[column], column).value_or(msg::kNone);
    } else {
      field = cell_as<Field>(cells[column], column);
    }
    ++column;
  });
  return message;
}

/// The query for a page of a message's recorded samples, from `after_seq` on.
inline std::string page_sql(const ReplayLog& log, std::string_view message, const std::vector<std::string>& columns,
                            std::int64_t after_seq) {
  constexpr int kPageRows = 1024;
  return fmt::format("SELECT {} FROM {} WHERE session_id = {} AND robot_id = {} AND seq > {} ORDER BY seq LIMIT {}",
                     fmt::join(columns, ", "), evaluator::log::table_of_message(message).value(), log.session_id,
                     log.robot_id, after_seq, kPageRows);
}

/// The recorded samples of a message in the order of seq, read a page at a time: a log may be larger than memory.
template <bus::Message T>
class RowPages {
 public:
  explicit RowPages(ReplayLog log) : log_(std::move(log)) { fill(); }

  /// The next sample without taking it; null at the end.
  const T* peek() const { return page_.empty() ? nullptr : &page_.front(); }

  /// Takes the next sample.
  std::optional<T> next() {
    if (page_.empty()) return std::nullopt;
    const T sample = page_.front();
    page_.pop_front();
    if (page_.empty()) fill();
    return sample;
  }

 private:
  void fill() {
    log_.reader->query(page_sql(log_, bus::meta<T>::name, bus::columns_of<T>(), after_seq_),
                       [this](std::span<const evaluator::log::Value> cells) {
                         page_.push_back(message_of<T>(cells));
                         after_seq_ = static_cast<std::int64_t>(page_.back().seq);
                       });
  }

  ReplayLog log_;
  std::int64_t after_seq_ = -1;
  std::deque<T> page_;
};

}  // namespace trivela::hal
