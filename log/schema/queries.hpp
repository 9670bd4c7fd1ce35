#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "log/schema/row.hpp"

namespace trivela::log {

/// Thrown where a cell does not hold what it is read as; Queries says it with the names of query and column.
struct WrongCell {
  std::size_t column = 0;  ///< from 0
  const char* wanted = "";
};

template <class T>
inline constexpr bool kMayBeNull = false;
template <class T>
inline constexpr bool kMayBeNull<std::optional<T>> = true;

/// Texts and bytes stay in their cell.
template <class T>
using CellAs = std::conditional_t<std::is_same_v<T, std::string> || std::is_same_v<T, Blob>, const T&, T>;

/// The cell as a bool, a whole number that T holds, a double, a std::string or a Blob, or as an std::optional of one,
/// which NULL alone leaves empty. Throws WrongCell.
template <class T>
CellAs<T> cell_as(const Value& cell, std::size_t column) {
  if constexpr (kMayBeNull<T>) {
    if (std::holds_alternative<std::monostate>(cell)) return std::nullopt;
    return cell_as<typename T::value_type>(cell, column);
  } else if constexpr (std::is_same_v<T, double>) {
    if (const auto* const number = std::get_if<double>(&cell)) return *number;
    if (const auto* const whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
    throw WrongCell{column, "a number"};
  } else if constexpr (std::is_integral_v<T>) {
    const auto* const whole = std::get_if<std::int64_t>(&cell);
    if constexpr (std::is_same_v<T, bool>) {
      if (whole != nullptr) return *whole != 0;
    } else {
      if (whole != nullptr && std::in_range<T>(*whole)) return static_cast<T>(*whole);
    }
    throw WrongCell{column, "a whole number of its range"};
  } else {
    if (const auto* const held = std::get_if<T>(&cell)) return *held;
    throw WrongCell{column, std::is_same_v<T, Blob> ? "bytes" : "a text"};
  }
}

/// The cells of one row of a query, read by the names of its columns: two that change places change nothing.
class NamedCells {
 public:
  explicit NamedCells(const std::vector<std::string>& names) : names_(names) {}

  void set(std::span<const Value> cells) { cells_ = cells; }

  /// The types are those of cell_as(). Throws std::logic_error where the query has no such column.
  template <class T>
  CellAs<T> get(std::string_view name) const {
    const std::size_t column = place_of(name);
    return cell_as<T>(cells_[column], column);
  }

  /// As get(); none where it is NULL.
  template <class T>
  std::optional<T> find(std::string_view name) const {
    return get<std::optional<T>>(name);
  }

 private:
  std::size_t place_of(std::string_view name) const {
    for (std::size_t tried = 0; tried < names_.size(); ++tried) {
      const std::size_t column = next_++ % names_.size();  // mostly they are read in their order
      if (names_[column] == name) return column;
    }
    throw std::logic_error("a query has no column " + std::string(name));
  }

  const std::vector<std::string>& names_;
  std::span<const Value> cells_;
  mutable std::size_t next_ = 0;
};

/// A question that is not one SELECT of what is there.
struct BadQuestion : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What can be asked by SQL, its rows read by type and name and not by number.
class Queries {
 public:
  /// Calls `fn` for each row of a query:
  /// - by name, where it takes one const NamedCells&: query(kSql, [&](const NamedCells& row) { row.get<int>("half");
  /// });
  /// - a few columns in their order: query("SELECT robot_id, power FROM ...", [&](int robot_id, double power) { });
  /// - the cells as they are, where it takes one std::span<const Value>.
  /// The types are those of cell_as(). Throws std::runtime_error where the query fails, would write, or has a cell of
  /// another type than is read; it names query and column.
  template <class F>
  void query(std::string_view sql, F&& fn) const {
    if constexpr (std::is_invocable_v<F&, const NamedCells&>) {
      std::vector<std::string> names;
      NamedCells row{names};
      each_row(
          sql, [&](const std::vector<std::string>& head) { names = head; },
          [&](std::span<const Value> cells) {
            row.set(cells);
            fn(std::as_const(row));
          });
    } else if constexpr (std::is_invocable_v<F&, std::span<const Value>>) {
      each_row(sql, {}, fn);
    } else {
      each_row(sql, {}, typed(fn, &std::remove_reference_t<F>::operator()));
    }
  }

  /// The rows of a query, each column in the member of the same place. Throws as query().
  template <class Row, class... Members>
  std::vector<Row> rows(std::string_view sql, Members... members) const {
    std::vector<Row> rows;
    each_row(sql, {}, [&](std::span<const Value> cells) {
      check_width(cells, sizeof...(members));
      Row& row = rows.emplace_back();
      std::size_t i = 0;
      ((row.*members = cell_as<std::remove_cvref_t<decltype(row.*members)>>(cells[i], i), ++i), ...);
    });
    return rows;
  }

 protected:
  ~Queries() = default;

 private:
  virtual void each_row(std::string_view sql, const HeadFunction& head, const RowFunction& fn) const = 0;

  static void check_width(std::span<const Value> cells, std::size_t read) {
    if (cells.size() != read) throw std::logic_error("a query has other columns than are read");
  }

  template <class F, class R, class L, class... A>
  static RowFunction typed(F& fn, R (L::*)(A...) const) {
    static_assert(sizeof...(A) <= 6, "read more columns by their names");
    return [&fn](std::span<const Value> cells) {
      check_width(cells, sizeof...(A));
      [&]<std::size_t... I>(std::index_sequence<I...>) { fn(cell_as<std::remove_cvref_t<A>>(cells[I], I)...); }
      (std::index_sequence_for<A...>{});
    };
  }
};

}  // namespace trivela::log
