#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "config/open_file.hpp"

namespace trivela::cli {

using config::open_file;

/// What config::open_file() can open, as a flag's check.
inline CLI::Validator readable_file() {
  return {[](const std::string& file) {
            const std::string why = config::why_unreadable(file);
            return why.empty() ? why : fmt::format("cannot read {}: {}", file, why);
          },
          "FILE"};
}

}  // namespace trivela::cli
