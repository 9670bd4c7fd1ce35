#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

#include "config/text/open_file.hpp"
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

using config::open_file;

/// What config::open_file() can open, as a flag's check. A file that cannot be read is no bad usage: it throws
/// std::runtime_error, as whoever reads the file later would.
inline CLI::Validator readable_file() {
  return {[](const std::string& file) -> std::string {
            const std::string why = config::why_unreadable(file);
            if (!why.empty()) throw std::runtime_error{fmt::format("cannot read {}: {}", file, why)};
            return {};
          },
          "FILE"};
}

}  // namespace trivela::cli
