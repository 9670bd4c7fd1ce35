#pragma once

#include <CLI/CLI.hpp>

namespace trivela::cli {

/// Each adds its subcommand of `trivela import`.
void add_import_refbox(CLI::App& verb, int& exit_code);
void add_import_kicks(CLI::App& verb, int& exit_code);

}  // namespace trivela::cli
