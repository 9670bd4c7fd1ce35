#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

#include "config/text/parse_number.hpp"

namespace trivela::cli {

/// Lets every number with a fraction that `verb` and its subcommands take be finite: CLI11 reads "nan" and "inf", and
/// its ranges let NaN through. Call it when all flags are there.
inline void require_finite_numbers(CLI::App& verb) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto value = config::parse_number(text);
    return value && !std::isfinite(*value) ? text + " is not a finite number" : "";
  };
  for (CLI::Option* option : verb.get_options()) {
    if (option->get_type_name().starts_with(CLI::detail::type_name<double>())) option->check(problem);
  }
  for (CLI::App* part : verb.get_subcommands(nullptr)) require_finite_numbers(*part);
}

}  // namespace trivela::cli
