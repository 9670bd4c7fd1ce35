#pragma once

#include "cli/verbs.hpp"

namespace trivela::cli {

// Subcommands of `trivela calibrate`.

AddVerb add_calibrate_table, add_calibrate_deflection, add_calibrate_rotation, add_calibrate_transfer;
AddVerb add_calibrate_delay, add_calibrate_from_log, add_calibrate_plot;

/// `trivela calibrate run --in simulation`: every test drive through the real nodes, from an uncalibrated robot to a
/// finished robot file. The simulator's truth is read once, for a report at the end.
AddVerb add_calibrate_run;

/// `trivela calibrate repeat`: many of them in process, beside the world's truth.
AddVerb add_calibrate_repeat;

}  // namespace trivela::cli
