#pragma once

#include <string>

#include "cli/watch/watch_page.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// Runs the nodes of a match, refbox among them, in real time against the simulator's emulated devices on a domain of
/// their own, and records to `out`; prints how long it took. `domain` < 0: drawn. `watch` as in record_lockstep().
/// Returns the exit code. Throws UsageError when `out` exists.
int record_emulated(config::Settings settings, int domain, const std::string& out, const WatchFlags* watch = nullptr);

/// The settings of a match against emulated devices: hal.kicker is an ioBoard where it was on the bus, and the
/// team has a multicast group.
config::Settings with_emulated_devices(config::Settings settings);

}  // namespace trivela::cli
