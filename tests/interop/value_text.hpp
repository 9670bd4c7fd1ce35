#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>

namespace trivela::interop {

/// Adds a line "name value" for each field, of whichever DDS' types: numbers exactly, enums as numbers, arrays element
/// by element, nested structs field by field. Both sides of a comparison print with it.
struct FieldText {
  std::string out;
  std::string prefix;

  template <class T>
  void operator()(const char* name, const T& value) {
    add(prefix + name, value);
  }

 private:
  template <class T>
  void add(const std::string& name, const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      char number[40];
      std::snprintf(number, sizeof number, "%a", value);
      out += name + " " + (std::isnan(value) ? "nan" : number) + "\n";
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      out += name + " " + std::to_string(static_cast<long long>(value)) + "\n";
    } else if constexpr (std::is_convertible_v<const T&, const char*>) {
      out += name + " " + static_cast<const char*>(value) + "\n";
    } else if constexpr (requires { value.c_str(); }) {
      out += name + " " + value.c_str() + "\n";
    } else if constexpr (requires { std::begin(value); }) {
      int i = 0;
      for (const auto& element : value) add(name + "[" + std::to_string(i++) + "]", element);
    } else {
      FieldText inner{{}, name + "."};
      visit_fields(value, inner);  // of the struct's namespace
      out += inner.out;
    }
  }
};

}  // namespace trivela::interop
