#pragma once

#include "cli/verbs.hpp"

namespace trivela::cli {

/// The verbs of trivela-emulate.
void add_ioboard(CLI::App& app, int& exit_code);
void add_rekick(CLI::App& app, int& exit_code);
void add_cia402(CLI::App& app, int& exit_code);
void add_mti(CLI::App& app, int& exit_code);
void add_refbox(CLI::App& app, int& exit_code);

}  // namespace trivela::cli
