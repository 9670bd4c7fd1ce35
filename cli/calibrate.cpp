#include "cli/verbs.hpp"

namespace trivela::cli {

void add_calibrate(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("calibrate", "A robot's kick model from laser scans, test drives, matches or measured tables");
  verb->require_subcommand(1);
  for (const auto add :
       {add_calibrate_table, add_calibrate_deflection, add_calibrate_rotation, add_calibrate_transfer,
        add_calibrate_delay, add_calibrate_from_log, add_calibrate_plot, add_calibrate_run, add_calibrate_repeat})
    add(*verb, exit_code);
}

}  // namespace trivela::cli
