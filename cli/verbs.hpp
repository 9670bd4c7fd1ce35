#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "config/text/error.hpp"

namespace trivela::cli {

/// Exit codes of every verb.
enum ExitCode : int { kDone = 0, kFailed = 1, kBadUsage = 2, kDoneWithLoss = 3 };

/// Flags that parse but make no sense together; `main` prints any BadArgument and exits with kBadUsage.
struct UsageError : config::BadArgument {
  using config::BadArgument::BadArgument;
};

/// Adds an option whose help shows its default. Throws what `check` says of other values.
template <class T>
CLI::Option* add_default(CLI::App& verb, const std::string& flag, T& value, const std::string& help,
                         const CLI::Validator& check = {}) {
  return verb.add_option(flag, value, help)->check(check)->capture_default_str();
}

/// A subcommand, and what its flags are read into.
template <class Flags>
struct Verb {
  CLI::App* verb;
  std::shared_ptr<Flags> flags;
};

/// Adds a subcommand that ends with the exit code of `run`, which gets its flags.
template <class Flags>
Verb<Flags> add_verb(CLI::App& app, int& exit_code, const std::string& name, const std::string& help,
                     int (*run)(const Flags&)) {
  Verb<Flags> added{app.add_subcommand(name, help), std::make_shared<Flags>()};
  added.verb->callback([flags = added.flags, run, &exit_code] { exit_code = run(*flags); });
  return added;
}

/// Adds its subcommand with flags, help and a callback that sets `exit_code`.
using AddVerb = void(CLI::App& app, int& exit_code);
AddVerb add_match, add_simulate, add_replay;
AddVerb add_scan, add_lob, add_calibrate;
AddVerb add_compare, add_study, add_report, add_drift, add_query;
AddVerb add_collect, add_merge, add_export, add_import, add_label, add_note;
AddVerb add_team, add_top, add_monitor, add_doctor, add_hardware, add_keys;
AddVerb add_solve, add_align, add_predict;

/// Of `trivela import`, beside the referee box's logs: what somebody labelled by hand.
AddVerb add_import_kicks;

// Subcommands of `trivela calibrate`.

AddVerb add_calibrate_table, add_calibrate_deflection, add_calibrate_rotation, add_calibrate_transfer;
AddVerb add_calibrate_delay, add_calibrate_from_log, add_calibrate_plot;

/// `trivela calibrate run --in simulation`: every test drive through the real nodes, from an uncalibrated robot to a
/// finished robot file. The simulator's truth is read once, for a report at the end.
AddVerb add_calibrate_run;

/// `trivela calibrate repeat`: many of them in process, beside the world's truth.
AddVerb add_calibrate_repeat;

}  // namespace trivela::cli
