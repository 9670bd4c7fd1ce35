#pragma once

#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "kicking/range.hpp"

/// How a configuration struct lists its fields, once, for reading, writing and testing:
///
///     void fields(auto& v, Odometry& o) {
///       v("wheel_radius_m", o.wheel_radius_m, Range{0.01, 0.5});
///       v("mounting_deg", Degrees{o.mounting_rad});
///     }
///
/// A std::optional is a key or a sub-table that may be absent. A field whose type has a `fields` of its own is a
/// sub-table.
namespace trivela::config {

using kicking::Degrees, kicking::Range;

/// What a file calls the values of an enum: an overload of `names_of` beside the enum, or beside the struct that uses
/// it, gives it.
///
///     inline EnumNames<DriveMode> names_of(DriveMode) { return {{"always", DriveMode::kAlways}, ...}; }
template <class E>
using EnumNames = std::vector<std::pair<std::string_view, E>>;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires(E e) {
  names_of(e).size();
};

/// Stands for any visitor when asking whether a type lists its fields.
struct AnyVisitor {
  template <class... Args>
  void operator()(Args&&...) {}
};

/// Where `v` reads a file, throws Error at `key` where `check` throws std::invalid_argument.
void require(auto& v, std::string_view key, const auto& check) {
  if constexpr (requires { v.require(key, check); }) v.require(key, check);
}

template <class T>
concept Section = requires(AnyVisitor v, T& t) {
  fields(v, t);
};

}  // namespace trivela::config
