#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace trivela::cli {

/// Lets every number with a fraction that `verb` and its subcommands take be finite: CLI11 reads "nan" and "inf", and
/// its ranges let NaN through. Call it when all flags are there.
inline void require_finite_numbers(CLI::App& verb) {
  const auto problem = [](const std::string& text) -> std::string {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && !std::isfinite(value) ? text + " is not a finite number" : "";
  };
  for (CLI::Option* option : verb.get_options()) {
    if (option->get_type_name().starts_with(CLI::detail::type_name<double>())) option->check(problem);
  }
  for (CLI::App* part : verb.get_subcommands(nullptr)) require_finite_numbers(*part);
}

}  // namespace trivela::cli
