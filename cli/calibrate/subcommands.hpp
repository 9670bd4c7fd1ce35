#pragma once

#include <CLI/CLI.hpp>

namespace trivela::cli {

// Subcommands of `trivela calibrate`. Each adds itself with flags, help and a callback that sets `exit_code`.

void add_calibrate_table(CLI::App& calibrate, int& exit_code);
void add_calibrate_deflection(CLI::App& calibrate, int& exit_code);
void add_calibrate_rotation(CLI::App& calibrate, int& exit_code);
void add_calibrate_transfer(CLI::App& calibrate, int& exit_code);
void add_calibrate_delay(CLI::App& calibrate, int& exit_code);
void add_calibrate_from_log(CLI::App& calibrate, int& exit_code);
void add_calibrate_plot(CLI::App& calibrate, int& exit_code);

/// `trivela calibrate run --in simulation`: every test drive through the real nodes, from an uncalibrated robot to a
/// finished robot file. The simulator's truth is read once, for a report at the end.
void add_calibrate_run(CLI::App& calibrate, int& exit_code);

/// `trivela calibrate repeat`: many of them in process, beside the world's truth.
void add_calibrate_repeat(CLI::App& calibrate, int& exit_code);

}  // namespace trivela::cli
