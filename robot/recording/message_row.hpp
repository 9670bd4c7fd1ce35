#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "idl/messages.hpp"
#include "log/schema/row.hpp"

namespace trivela::robot {

using bus::columns_of;

/// The table of a message that is recorded. Throws std::logic_error where the schema has none.
template <bus::Struct T>
std::string table_of() {
  if (auto table = log::table_of_message(bus::meta<T>::name)) return *std::move(table);
  throw std::logic_error("the match log has no table of " + std::string(bus::meta<T>::name));
}

/// The text of an enum in a message's row.
template <class T, class Enum>
const char* text_of(const T&, const Enum& field) {
  return bus::label(field);
}
inline const char* text_of(const msg::KickDecision& decision, const msg::Policy&) { return msg::policy_name(decision); }

/// Gives the cells of a message in the order of columns_of<T>() to the sink's integer(), number() and text(): enums by
/// their label, the policy of a decision by its name, booleans as 0 and 1.
template <bus::Struct T>
void write_cells(auto& sink, const T& message) {
  bus::visit_values(message, [&](const auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (bus::Enumeration<Field>) {
      sink.text(text_of(message, field));
    } else if constexpr (std::is_floating_point_v<Field>) {
      sink.number(static_cast<double>(field));
    } else {
      sink.integer(static_cast<std::int64_t>(field));
    }
  });
}

/// A sink that keeps them.
struct RowCells {
  std::vector<log::Value> cells;

  void integer(std::int64_t value) { cells.emplace_back(value); }
  void number(double value) { cells.emplace_back(value); }
  void text(const char* value) { cells.emplace_back(std::string{value}); }
};

/// The cells of a message in the order of columns_of<T>().
template <bus::Struct T>
std::vector<log::Value> row_of(const T& message) {
  RowCells row;
  row.cells.reserve(bus::meta<T>::fields.size());
  write_cells(row, message);
  return std::move(row.cells);
}

/// Shadows stand in a table of their own, by their decision and place.
inline std::vector<std::string> shadow_columns() {
  std::vector<std::string> columns{"robot_id", "seq", "shadow_index"};
  for (std::string& column : columns_of<msg::ShadowDecision>()) columns.push_back(std::move(column));
  return columns;
}

void write_shadow(auto& sink, std::int64_t robot_id, std::int64_t seq, std::int64_t index,
                  const msg::ShadowDecision& shadow) {
  for (const std::int64_t key : {robot_id, seq, index}) sink.integer(key);
  write_cells(sink, shadow);
}

/// Who was in charge of a possession, and the instant of the first decision of it in play.
inline std::vector<std::string> assignment_columns() {
  return {"robot_id", "half", "possession_id", "policy", "probability", "t_ns"};
}

void write_assignment(auto& sink, std::int64_t robot_id, std::int64_t half, std::int64_t possession_id,
                      const char* policy, double probability, std::int64_t t_ns) {
  for (const std::int64_t key : {robot_id, half, possession_id}) sink.integer(key);
  sink.text(policy);
  sink.number(probability);
  sink.integer(t_ns);
}

}  // namespace trivela::robot
