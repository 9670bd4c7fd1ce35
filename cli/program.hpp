#pragma once

#include <string>
#include <vector>

#include "cli/verbs.hpp"

namespace trivela::cli {

/// Verbs by what a person wants, in the order of the help.
struct VerbGroup {
  const char* wish;
  std::vector<void (*)(CLI::App&, int&)> verbs;
};

/// A program made of verbs.
struct ProgramInfo {
  std::string name;
  std::string what;    ///< one line
  std::string footer;  ///< of its help
  std::vector<VerbGroup> verbs;
  bool has_manual = false;  ///< --man and --completion
};

/// Runs the verb that the command line names, and says what goes wrong on standard error. Returns the exit code.
int run_program(const ProgramInfo& program, int argc, char** argv);

/// The program `trivela`: runs the verb that the command line names. Returns the exit code.
int run_verbs(int argc, char** argv);

}  // namespace trivela::cli
