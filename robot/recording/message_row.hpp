#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "evaluator/log/value.hpp"
#include "idl/messages.hpp"

namespace trivela::robot {

/// Fields that are structs in an array become rows of a table of their own.
template <class Field>
inline constexpr bool kIsNested = std::is_array_v<Field>;

/// The columns of a message: the names of its plain fields, in the order of the IDL.
template <bus::Struct T>
std::vector<std::string> columns_of() {
  std::vector<std::string> columns;
  const T message{};
  bus::visit_fields(message, [&](std::string_view name, std::string_view, const auto& field) {
    if constexpr (!kIsNested<std::remove_cvref_t<decltype(field)>>) columns.emplace_back(name);
  });
  return columns;
}

/// One cell: enums by their label, booleans as 0 and 1.
template <class Field>
evaluator::log::Value cell(const Field& field) {
  if constexpr (bus::Enumeration<Field>) {
    return std::string{bus::label(field)};
  } else if constexpr (std::is_floating_point_v<Field>) {
    return static_cast<double>(field);
  } else {
    return static_cast<std::int64_t>(field);
  }
}

/// The cells of a message in the order of columns_of<T>().
template <bus::Struct T>
std::vector<evaluator::log::Value> row_of(const T& message) {
  std::vector<evaluator::log::Value> row;
  row.reserve(bus::meta<T>::fields.size());
  bus::visit_fields(message, [&](std::string_view, std::string_view, const auto& field) {
    if constexpr (!kIsNested<std::remove_cvref_t<decltype(field)>>) row.push_back(cell(field));
  });
  return row;
}

}  // namespace trivela::robot
