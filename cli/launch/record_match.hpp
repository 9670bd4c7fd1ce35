#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/launch/log_claim.hpp"
#include "cli/launch/match_run.hpp"
#include "cli/watch/watch_page.hpp"
#include "config/settings.hpp"

namespace trivela::cli {

/// The settings of a run that records to `log`: on a domain and tag of its own, with absolute file names. `domain` < 0:
/// drawn.
config::Settings match_settings(config::Settings settings, int domain, const std::string& log);

/// The same in lockstep.
config::Settings lockstep_settings(config::Settings settings, int domain, const std::string& log);

/// The processes of a robot in a match, the recorder first: without the simulator, and without refbox.
std::vector<std::string> nodes_of_match(const config::Settings& settings);

/// Rows that the log says it is missing, with a sentence on standard error where there are any.
std::int64_t lost_rows(const std::string& log);

/// Prints how fast a match went, and on standard error how it was broken off. Returns the exit code.
int say_how_it_went(const MatchResult& result, const LogClaim& log, const std::string& out);

/// Throws UsageError naming the first device that has a time of its own: a match in lockstep is not for it.
void refuse_real_devices(const config::Hal& devices);

/// Runs the nodes with `feeder` in lockstep on a domain of their own and records to `out`; prints how fast it went.
/// `domain` < 0: drawn. `watch`: its live page is served there, and stays until somebody asks to stop; nullptr: none.
/// Returns the exit code. Throws UsageError when `out` exists: a recorded match is never overwritten.
int record_lockstep(const std::string& feeder, config::Settings settings, int domain, const std::string& out,
                    const WatchFlags* watch = nullptr);

/// Runs the nodes of a match, refbox among them, in real time against the simulator's emulated devices on a domain of
/// their own, and records to `out`; prints how long it took. `domain` < 0: drawn. `watch` as in record_lockstep().
/// Returns the exit code. Throws UsageError when `out` exists.
int record_emulated(config::Settings settings, int domain, const std::string& out, const WatchFlags* watch = nullptr);

/// The settings of a match against emulated devices: hal.kicker is an ioBoard where it was on the bus, and the
/// team has a multicast group.
config::Settings with_emulated_devices(config::Settings settings);

}  // namespace trivela::cli
