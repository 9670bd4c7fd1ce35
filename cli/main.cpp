#include <cstdio>
#include <exception>

#include "cli/verbs.hpp"

namespace cli = trivela::cli;

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Trivela: kick decisions, match logs and their evaluation for robot soccer"};
  app.name("trivela");
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.");
  int exit_code = cli::kDone;
  cli::add_match(app, exit_code);
  cli::add_replay(app, exit_code);
  cli::add_simulate(app, exit_code);
  cli::add_scan(app, exit_code);
  cli::add_lob(app, exit_code);
  cli::add_calibrate(app, exit_code);
  cli::add_report(app, exit_code);
  cli::add_compare(app, exit_code);
  cli::add_evaluate_policy(app, exit_code);
  cli::add_learn(app, exit_code);
  cli::add_factorial(app, exit_code);
  cli::add_frontier(app, exit_code);
  cli::add_sensitivity(app, exit_code);
  cli::add_solve(app, exit_code);
  cli::add_align(app, exit_code);
  cli::add_predict(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return cli::kBadUsage;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) try { return run(argc, argv); } catch (const cli::UsageError& error) {
  std::fprintf(stderr, "trivela: %s\n", error.what());
  return cli::kBadUsage;
} catch (const std::exception& error) {
  std::fprintf(stderr, "trivela: %s\n", error.what());
  return cli::kFailed;
}
