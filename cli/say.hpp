#pragma once

#include <fmt/format.h>

#include <string_view>

#include "kicking/text/printable.hpp"

namespace trivela::cli {

/// Lines for people, on standard output. Names in a log, a table or a path come from anybody: what a terminal could
/// obey is written as \xNN.
inline void say(std::string_view lines) { fmt::print("{}", kicking::printable_lines(lines)); }

/// A sentence on standard error, by the same rule.
inline void warn(std::string_view sentence) { fmt::print(stderr, "trivela: {}\n", kicking::printable_lines(sentence)); }

}  // namespace trivela::cli
