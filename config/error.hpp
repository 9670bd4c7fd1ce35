#pragma once

#include <stdexcept>

namespace trivela::config {

/// A configuration that cannot be used; the message names file, line, key and value.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace trivela::config
