#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cli/hardware/fixtures.hpp"
#include "cli/launch/signal_inbox.hpp"

namespace trivela::cli {

/// Lists the devices, once all have answered or 3 s are over, and shows their values: on a terminal drawn over five
/// times a second until somebody asks to stop, else a line each second; both for `seconds`, where it is given, a
/// pipe's for one. Returns the exit code: kFailed where a device that is wanted does not answer.
int watch(std::vector<std::unique_ptr<Fixture>>& fixtures, std::optional<double> seconds, SignalInbox& signals);

}  // namespace trivela::cli
