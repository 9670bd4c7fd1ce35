#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>

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

/// An angle in rad that the file shows in degrees.
struct Degrees {
  double& rad;
};

/// The values that a number may take, both ends included, in the unit of its key.
struct Range {
  double min;
  double max;
};

/// Any wrapper with a `rad` reference is an angle shown in degrees.
template <class T>
concept AngleField = requires(T t) {
  { t.rad } -> std::convertible_to<double>;
};

/// The enums that a file may name, specialised beside the struct that uses one:
/// `static constexpr std::array<std::pair<std::string_view, E>, N> entries`.
template <class E>
struct Names;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  Names<E>::entries.size();
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
