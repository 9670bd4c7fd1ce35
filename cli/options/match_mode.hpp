#pragma once

#include <stdexcept>
#include <string>

#include "config/settings.hpp"

namespace trivela::cli {

/// A verb that acts on a robot or changes a log through a page asks first. Throws std::runtime_error naming `what`
/// where a match is on.
inline void refuse_in_a_match(const config::Settings& settings, const std::string& what) {
  if (settings.run.match_mode) throw std::runtime_error{"run.match_mode = true: a match is on, and " + what + " waits"};
}

}  // namespace trivela::cli
