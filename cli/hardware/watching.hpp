#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/hardware/device_probes.hpp"
#include "cli/launch/signal_inbox.hpp"

namespace trivela::cli {

using DeviceProbes = std::vector<std::unique_ptr<DeviceProbe>>;

/// Every device that is wanted was opened and answers.
bool all_answer(const DeviceProbes& probes);

/// A row for each: is it there, and what it says.
std::string listing(const DeviceProbes& probes);

/// Lists the devices, once all have answered or 3 s are over, and shows their values: on a terminal drawn over five
/// times a second until somebody asks to stop, else a line each second; both for `seconds`, where it is given, a
/// pipe's for one. Returns the exit code: kFailed where not all_answer(), or one did not for a while, which it warns
/// of.
int watch(DeviceProbes& probes, std::optional<double> seconds, SignalInbox& signals);

}  // namespace trivela::cli
