#pragma once

#include <stdexcept>

namespace trivela::config {

/// A configuration that cannot be used; the message names file, line, key and value.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a caller asked for makes no sense; the message names the value. A program that was asked by flags ends as for
/// bad usage.
struct BadArgument : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace trivela::config
