#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "config/text/parse_number.hpp"

namespace trivela::cli {

/// Limits of a number as a flag's check, said in the words of whoever wrote them: CLI::Range writes the bounds of a
/// double in 300 digits, and lets NaN through.
class NumberCheck : public CLI::Validator {
 public:
  template <class Holds>
  NumberCheck(const std::string& limits, Holds holds) : Validator{limits} {
    func_ = [limits, holds](const std::string& text) {
      const auto value = config::parse_number(text);
      return value && holds(*value) ? std::string{} : fmt::format("{} is not {}", text, limits);
    };
  }
};

/// From least to most, both included.
inline NumberCheck between(double least, double most) {
  return {fmt::format("within {} to {}", least, most), [=](double value) { return value >= least && value <= most; }};
}

/// Above 0.
inline NumberCheck above_zero() {
  return {"above 0", [](double value) { return value > 0.0; }};
}

/// What every seed of this program must lie in: it is kept as a double where it meets a configuration.
inline CLI::Range seeds() { return {std::uint64_t{0}, std::uint64_t{9'000'000'000'000'000}}; }

}  // namespace trivela::cli
