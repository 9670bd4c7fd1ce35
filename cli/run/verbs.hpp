#pragma once

namespace trivela::cli {

/// The program `trivela`: runs the verb that the command line names. Returns the exit code.
int run_verbs(int argc, char** argv);

}  // namespace trivela::cli
