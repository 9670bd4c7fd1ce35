// What the code generated from the IDL says about each message type.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

struct dds_topic_descriptor;

namespace trivela::bus {

/// QoS profile of a topic, @profile in the IDL; what each means stands in idl/README.md.
enum class Profile { kState, kOrder, kEvent };

/// One field of a message: its name, its @unit ("" without one) and whether it is part of the key.
struct Field {
  std::string_view name;
  std::string_view unit;
  bool key;
};

/// One value of an IDL enum and its label: lower case without the enum's common prefix.
template <class Enum>
struct Enumerator {
  Enum value;
  const char* label;
};

/// Specialised by the generated code for each struct T of the IDL: `name`, `fields`, `members` (pointers to them, in
/// the same order), `visit(message, f)`; for a topic also `topic`, `profile`, `writers` (@writers, the kinds of nodes
/// that may write it), `period_s` (@period, the longest time between two samples while all is well; 0: none) and
/// `descriptor()`.
template <class T>
struct meta;

/// Specialised by the generated code for each enum of the IDL: `name`, `enumerators`.
template <class T>
struct enumeration;

/// A struct of the IDL, topic or nested.
template <class T>
concept Struct = requires {
  meta<std::remove_const_t<T>>::fields;
};

/// A struct of the IDL that a topic carries.
template <class T>
concept Message = Struct<T> && requires {
  meta<T>::topic;
};

/// An enum of the IDL.
template <class T>
concept Enumeration = requires {
  enumeration<T>::enumerators;
};

/// Calls f(name, unit, field) for each field of the message in the order of the IDL. Arrays come as arrays, enums as
/// enums, nested structs as structs. A non-const message gives fields that may be written.
template <class T, class F>
requires Struct<std::remove_reference_t<T>>
constexpr void visit_fields(T&& message, F&& f) { meta<std::remove_cvref_t<T>>::visit(message, f); }

/// Calls f(field) for each value of the message: the columns of the message in a table. An array of doubles is as many
/// columns; other arrays and structs are none.
template <class T, class F>
requires Struct<std::remove_reference_t<T>>
constexpr void visit_values(T&& message, F&& f) {
  visit_fields(message, [&](std::string_view, std::string_view, auto& field) {
    using Value = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_array_v<Value> && std::is_floating_point_v<std::remove_extent_t<Value>>) {
      for (auto& value : field) f(value);
    } else if constexpr (!std::is_array_v<Value> && !Struct<Value>) {
      f(field);
    }
  });
}

/// The name of an array's column: "speed_2_mps" of "speed_mps".
inline std::string column_of(std::string_view name, std::size_t index) {
  const std::size_t unit = std::min(name.rfind('_'), name.size());
  return std::string{name.substr(0, unit)} + '_' + std::to_string(index) + std::string{name.substr(unit)};
}

/// The names of these columns.
template <Struct T>
std::vector<std::string> columns_of() {
  std::vector<std::string> columns;
  visit_fields(T{}, [&](std::string_view name, std::string_view, const auto& field) {
    using Value = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_array_v<Value> && std::is_floating_point_v<std::remove_extent_t<Value>>) {
      for (std::size_t i = 0; i < std::extent_v<Value>; ++i) columns.push_back(column_of(name, i));
    } else if constexpr (!std::is_array_v<Value> && !Struct<Value>) {
      columns.emplace_back(name);
    }
  });
  return columns;
}

/// The label of an enum's value, e.g. "wide_left" for OUTCOME_WIDE_LEFT; "invalid" for a number outside the enum (the
/// bus does not check the range).
template <Enumeration E>
constexpr const char* label(const E& value) {
  // By its bits: to load a number outside the enum as its type is undefined.
  const auto number = std::bit_cast<std::underlying_type_t<E>>(value);
  for (const auto& e : enumeration<E>::enumerators)
    if (std::bit_cast<std::underlying_type_t<E>>(e.value) == number) return e.label;
  return "invalid";
}

/// Whether the enum's values are 0, 1, ... and have these labels in this order: an enum of the same names may be cast.
template <Enumeration E>
constexpr bool has_labels(std::span<const char* const> names) {
  std::size_t place = 0;
  for (const auto& e : enumeration<E>::enumerators)
    if (place >= names.size() || static_cast<std::size_t>(e.value) != place ||
        std::string_view{e.label} != names[place++])
      return false;
  return place == names.size();
}

/// The value with that label, if there is one.
template <Enumeration E>
constexpr std::optional<E> from_label(std::string_view text) {
  for (const auto& e : enumeration<E>::enumerators)
    if (text == e.label) return e.value;
  return std::nullopt;
}

}  // namespace trivela::bus

namespace trivela::msg {
using bus::label;
using bus::visit_fields;
}  // namespace trivela::msg
