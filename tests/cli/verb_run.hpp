#pragma once

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <vector>

#include "cli/verbs.hpp"

namespace trivela::cli {

/// What verbs of the program printed in this process, and their exit code.
struct VerbRun {
  std::string out;
  std::string errors;
  int exit_code = -1;
};

/// Parses `words` (a line, or in CLI11's order: the last first) with these verbs. Throws what they throw.
template <class Words>
VerbRun run_parsed(std::initializer_list<AddVerb*> verbs, Words words) {
  CLI::App app;
  VerbRun run;
  for (AddVerb* const add : verbs) add(app, run.exit_code);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  try {
    app.parse(words);
  } catch (...) {
    testing::internal::GetCapturedStdout();
    testing::internal::GetCapturedStderr();
    throw;
  }
  run.out = testing::internal::GetCapturedStdout();
  run.errors = testing::internal::GetCapturedStderr();
  return run;
}

/// The verbs as a user types them, `line` without "trivela".
inline VerbRun run_verbs(std::initializer_list<AddVerb*> verbs, const std::string& line) {
  return run_parsed(verbs, line);
}
/// The same in words, which may hold blanks.
inline VerbRun run_verbs(std::initializer_list<AddVerb*> verbs, const std::vector<std::string>& words) {
  return run_parsed(verbs, std::vector<std::string>(words.rbegin(), words.rend()));
}

}  // namespace trivela::cli
