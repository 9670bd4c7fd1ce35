#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "idl/messages.hpp"
#include "idl/meta.hpp"
#include "log/read/reader.hpp"

namespace trivela::experiment {

/// One robot's part of one session in a match log. The reader outlives it.
struct RecordedRobot {
  const log::Reader& reader;
  std::int64_t session_id = 0;
  int robot_id = 0;
  bool lockstep = false;  ///< its streams share their instants
};

/// Sets the enum of a message by its text in the row; false: it is none.
template <class T, class Enum>
bool take_label(T&, Enum& field, const std::string& label) {
  const auto value = bus::from_label<Enum>(label);
  if (value) field = *value;
  return value.has_value();
}
inline bool take_label(msg::KickDecision& decision, msg::Policy& field, const std::string& label) {
  const auto value = bus::from_label<msg::Policy>(label);
  field = value.value_or(msg::POLICY_OWN);
  if (!value) label.copy(decision.own_policy, sizeof decision.own_policy - 1);
  return true;
}

/// The message whose columns_of<T>() a row holds; NaN for a number that is NULL. Throws WrongCell.
template <bus::Message T>
T message_of(std::span<const log::Value> cells) {
  using log::cell_as;
  T message{};
  std::size_t column = 0;
  bus::visit_values(message, [&](auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (bus::Enumeration<Field>) {
      const auto label = cell_as<std::string>(cells[column], column);
      if (!take_label(message, field, label)) throw log::WrongCell{column, "a label of its enum"};
    } else if constexpr (std::is_floating_point_v<Field>) {
      field = cell_as<std::optional<Field>>(cells[column], column).value_or(msg::kNone);
    } else {
      field = cell_as<Field>(cells[column], column);
    }
    ++column;
  });
  return message;
}

/// The recorded samples of a message in the order of seq, read a page at a time: a log may be larger than memory.
/// Throws std::runtime_error naming the query where the log cannot be read.
template <bus::Message T>
class RowPages {
 public:
  explicit RowPages(const RecordedRobot& robot) : robot_(robot) { fill(); }

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
    constexpr int kPageRows = 1024;
    const auto sql =
        fmt::format("SELECT {} FROM {} WHERE session_id = {} AND robot_id = {} AND seq > {} ORDER BY seq LIMIT {}",
                    fmt::join(bus::columns_of<T>(), ", "), log::table_of_message(bus::meta<T>::name).value(),
                    robot_.session_id, robot_.robot_id, after_seq_, kPageRows);
    robot_.reader.query(sql, [this](std::span<const log::Value> cells) {
      page_.push_back(message_of<T>(cells));
      after_seq_ = static_cast<std::int64_t>(page_.back().seq);
    });
  }

  RecordedRobot robot_;
  std::int64_t after_seq_ = -1;
  std::deque<T> page_;
};

/// How far two messages are apart: the number of columns that differ, of numbers the distance up to 1. seq and kick_id
/// do not count. 0: they are the same to the last bit.
template <bus::Message T>
double distance(const T& a, const T& b) {
  const auto apart = [](const auto& left, const auto& right) {
    using Field = std::remove_cvref_t<decltype(left)>;
    if constexpr (std::is_array_v<Field>) {
      return 0.0;  // no column
    } else if constexpr (std::is_floating_point_v<Field>) {
      if (left == right || (std::isnan(left) && std::isnan(right))) return 0.0;
      const double by = std::abs(left - right);
      return by < 1.0 ? by : 1.0;
    } else {
      return left == right ? 0.0 : 1.0;
    }
  };
  const auto& fields = bus::meta<T>::fields;
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return ((fields[I].name == "seq" || fields[I].name == "kick_id"
                 ? 0.0
                 : apart(a.*std::get<I>(bus::meta<T>::members), b.*std::get<I>(bus::meta<T>::members))) +
            ...);
  }
  (std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<decltype(bus::meta<T>::members)>>>{});
}

/// The recorded samples of one topic, of which a node has the latest that came.
template <bus::Message T>
class InputStream {
 public:
  explicit InputStream(const RecordedRobot& robot) : pages_(robot) {}

  /// How many samples have come by then that the node does not have yet.
  std::size_t come_by(std::int64_t t_ns) {
    while (pages_.peek() != nullptr && pages_.peek()->t_ns <= t_ns) ahead_.push_back(*pages_.next());
    std::size_t count = 0;
    while (count < ahead_.size() && ahead_[count].t_ns <= t_ns) ++count;
    return count;
  }

  /// What it has when so many of come_by() have come; nullptr: nothing yet.
  const T* after(std::size_t count) const {
    if (count > 0) return &ahead_[count - 1];
    return latest_ ? &*latest_ : nullptr;
  }

  /// They have come.
  void take(std::size_t count) {
    if (count == 0) return;
    latest_ = ahead_[count - 1];
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(count));
  }

 private:
  RowPages<T> pages_;
  std::deque<T> ahead_;
  std::optional<T> latest_;
};

}  // namespace trivela::experiment
