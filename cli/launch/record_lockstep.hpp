#pragma once

#include <string>

#include "config/settings.hpp"

namespace trivela::cli {

/// Runs the nodes with `feeder` in lockstep on a domain of their own and records to `out`; prints how fast it went.
/// `domain` < 0: drawn. Returns the exit code. Throws UsageError when `out` exists: a recorded match is never
/// overwritten.
int record_lockstep(const std::string& feeder, config::Settings settings, int domain, const std::string& out);

}  // namespace trivela::cli
