#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kicking/optional_double.hpp"
#include "log/schema/row.hpp"
#include "python/arrays.hpp"

namespace trivela::python {

/// Cells of one column, which may be missing. Needs no interpreter until it becomes arrays.
class Column {
 public:
  void add(std::nullopt_t);
  void add(bool truth);
  void add(double number);
  void add(kicking::OptionalDouble number) { number ? add(*number) : add(std::nullopt); }
  void add(std::string_view text);
  void add(const char* text) { add(std::string_view(text)); }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(std::integral auto whole) requires(!std::same_as<decltype(whole), bool>) {
    add_whole(static_cast<std::int64_t>(whole));
  }
  template <class T>
  void add(const std::optional<T>& cell) {
    cell ? add(*cell) : add(std::nullopt);
  }
  void add(const log::Value& cell);

  /// ("whole", int64, missing), ("truth", uint8, missing), ("number", float64, missing) or ("text", places, texts),
  /// whose first text is None; ("none", missing) where every cell is missing. Leaves the column empty.
  py::tuple arrays();

 private:
  void add_whole(std::int64_t whole);
  void add_cell(std::int64_t whole, double number, std::int32_t place, bool missing);

  std::vector<std::int64_t> whole_;
  std::vector<double> numbers_;
  std::vector<std::int32_t> places_;
  std::vector<std::uint8_t> missing_;
  std::map<std::string, std::int32_t, std::less<>> texts_;
  std::vector<std::string> in_order_;
  bool has_whole_ = false, has_truths_ = false, has_numbers_ = false;
};

/// Columns of rows that name the same cells in the same order.
class Columns {
 public:
  void begin_row() { next_ = 0; }

  template <class Cell>
  void add(const char* name, const Cell& cell) {
    if (next_ == columns_.size()) {
      names_.emplace_back(name);
      columns_.emplace_back();
    }
    columns_[next_++].add(cell);
  }

  /// {name: Column::arrays()}.
  py::dict arrays();

 private:
  std::vector<std::string> names_;
  std::vector<Column> columns_;
  std::size_t next_ = 0;
};

}  // namespace trivela::python
