#include "cli/verbs.hpp"

namespace trivela::cli {

void add_calibrate(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("calibrate", "A robot's kick model from laser scans, test drives, matches or measured tables");
  verb->require_subcommand(1);
  add_calibrate_table(*verb, exit_code);
  add_calibrate_deflection(*verb, exit_code);
  add_calibrate_rotation(*verb, exit_code);
  add_calibrate_transfer(*verb, exit_code);
  add_calibrate_delay(*verb, exit_code);
  add_calibrate_from_log(*verb, exit_code);
  add_calibrate_plot(*verb, exit_code);
  add_calibrate_run(*verb, exit_code);
  add_calibrate_repeat(*verb, exit_code);
}

}  // namespace trivela::cli
