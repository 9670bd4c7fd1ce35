#pragma once

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace trivela::python {

namespace py = pybind11;

/// A number that there is not.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// One of several arrays of one length, flat: the Python side has brought them to one shape.
template <class T>
using Flat = py::array_t<T, py::array::c_style | py::array::forcecast>;

template <class T>
std::span<const T> span_of(const Flat<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// The vector as an array that owns it.
template <class T>
py::array_t<T> array_of(std::vector<T> values) {
  auto held = std::make_unique<std::vector<T>>(std::move(values));
  const auto size = static_cast<py::ssize_t>(held->size());
  const T* const data = held->data();
  const py::capsule owner(held.release(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return py::array_t<T>(size, data, owner);
}

/// Truths as an array of bool: std::vector<bool> has no data.
inline py::array array_of_truths(std::vector<std::uint8_t> values) {
  return array_of(std::move(values)).attr("view")("bool");
}

/// Throws ValueError naming the argument, the place in it and the value, where one breaks the rule.
template <class Holds>
void require(const char* name, std::span<const double> values, const char* rule, Holds holds) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && holds(values[i])) continue;
    throw py::value_error(
        fmt::format("{}[{}]: '{:g}' {}", name, i, values[i], std::isfinite(values[i]) ? rule : "is not finite"));
  }
}

inline void require_finite(const char* name, std::span<const double> values) {
  require(name, values, "", [](double) { return true; });
}
inline void require_positive(const char* name, std::span<const double> values) {
  require(name, values, "is not above 0", [](double x) { return x > 0.0; });
}
/// From 0 to `most`.
inline void require_up_to(const char* name, std::span<const double> values, double most) {
  require(name, values, fmt::format("is not from 0 to {:g}", most).c_str(),
          [most](double x) { return x >= 0.0 && x <= most; });
}

/// Each adds its functions to the module.
void add_robots(py::module_& module);
void add_kicks(py::module_& module);
void add_judgement(py::module_& module);
void add_policies(py::module_& module);
void add_simulate(py::module_& module);
void add_logs(py::module_& module);
void add_comparisons(py::module_& module);
void add_statistics(py::module_& module);
void add_calibration(py::module_& module);

}  // namespace trivela::python
