#pragma once

#include <CLI/CLI.hpp>

#include "config/text/error.hpp"

namespace trivela::cli {

/// Exit codes of every verb.
enum ExitCode : int { kDone = 0, kFailed = 1, kBadUsage = 2, kDoneWithLoss = 3 };

/// Flags that parse but make no sense together; `main` prints any BadArgument and exits with kBadUsage.
struct UsageError : config::BadArgument {
  using config::BadArgument::BadArgument;
};

/// Each adds its subcommand with flags, help and a callback that sets `exit_code`.
void add_match(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_scan(CLI::App& app, int& exit_code);
void add_top(CLI::App& app, int& exit_code);
void add_monitor(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_hardware(CLI::App& app, int& exit_code);
void add_keys(CLI::App& app, int& exit_code);
void add_lob(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_collect(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_label(CLI::App& app, int& exit_code);
void add_note(CLI::App& app, int& exit_code);
void add_query(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_drift(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_study(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_solve(CLI::App& app, int& exit_code);
void add_align(CLI::App& app, int& exit_code);
void add_predict(CLI::App& app, int& exit_code);
void add_team(CLI::App& app, int& exit_code);

/// Of `trivela import`, beside the referee box's logs: what somebody labelled by hand.
void add_import_kicks(CLI::App& import, int& exit_code);

}  // namespace trivela::cli
