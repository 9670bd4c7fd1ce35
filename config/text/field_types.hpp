#pragma once

#include <array>
#include <string_view>
#include <type_traits>
#include <utility>

#include "kicking/range.hpp"

/// How a configuration struct lists its fields, once, for reading, writing and testing:
///
///     template <class V> void fields(V& v, Odometry& o) {
///       v("wheel_radius_m", o.wheel_radius_m, Range{0.01, 0.5});
///       v("mounting_deg", Degrees{o.mounting_rad});
///     }
///
/// A std::optional is a key or a sub-table that may be absent. A field whose type has a `fields` of its own is a
/// sub-table.
namespace trivela::config {

using kicking::Degrees, kicking::Range;

/// The enums that a file may name, specialised beside the struct that uses one:
/// `static constexpr std::array<std::pair<std::string_view, E>, N> entries`, or a function `entries()` that gives a
/// list of such pairs.
template <class E>
struct Names;

/// The names and values of E.
template <class E>
auto names_of() {
  if constexpr (requires { Names<E>::entries(); })
    return Names<E>::entries();
  else
    return Names<E>::entries;
}

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  names_of<E>().size();
};

/// Stands for any visitor when asking whether a type lists its fields.
struct AnyVisitor {
  template <class... Args>
  void operator()(Args&&...) {}
};

template <class T>
concept Section = requires(AnyVisitor v, T& t) {
  fields(v, t);
};

}  // namespace trivela::config
