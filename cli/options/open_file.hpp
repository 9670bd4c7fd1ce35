#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

#include "config/text/open_file.hpp"

namespace trivela::cli {

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
