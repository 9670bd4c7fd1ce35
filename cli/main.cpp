#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <system_error>

#include "cli/finite_numbers.hpp"
#include "cli/say.hpp"
#include "cli/verbs.hpp"
#include "config/software_version.hpp"
#include "nodes/runtime/standard_streams.hpp"

namespace cli = trivela::cli;

namespace {

/// The first word where a verb of `app` must stand and none does; none: what is wrong is something else.
std::optional<std::string> unknown_verb(const CLI::App& app, int argc, char** argv) {
  const CLI::App* at = &app;
  for (int i = 1; i < argc; ++i) {
    const auto verbs = at->get_subcommands([](const CLI::App* part) { return !part->get_name().empty(); });
    const auto verb = std::ranges::find(verbs, argv[i], &CLI::App::get_name);
    if (verb == verbs.end()) {
      return verbs.empty() || argv[i][0] == '-' ? std::nullopt : std::optional<std::string>{argv[i]};
    }
    at = *verb;
  }
  return std::nullopt;
}

int run(int argc, char** argv) {
  CLI::App app{"Trivela: kick decisions, match logs and their evaluation for robot soccer"};
  app.name("trivela");
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("trivela {}", trivela::config::software_version()));
  app.footer("Exit codes: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.");
  int exit_code = cli::kDone;
  cli::add_match(app, exit_code);
  cli::add_replay(app, exit_code);
  cli::add_simulate(app, exit_code);
  cli::add_scan(app, exit_code);
  cli::add_lob(app, exit_code);
  cli::add_calibrate(app, exit_code);
  cli::add_report(app, exit_code);
  cli::add_migrate(app, exit_code);
  cli::add_compare(app, exit_code);
  cli::add_evaluate_policy(app, exit_code);
  cli::add_learn(app, exit_code);
  cli::add_factorial(app, exit_code);
  cli::add_frontier(app, exit_code);
  cli::add_sensitivity(app, exit_code);
  cli::add_tune(app, exit_code);
  cli::add_solve(app, exit_code);
  cli::add_align(app, exit_code);
  cli::add_predict(app, exit_code);
  cli::require_finite_numbers(app);
  if (const auto word = unknown_verb(app, argc, argv))
    throw cli::UsageError{fmt::format("there is no verb \"{}\"; trivela --help names them all", *word)};
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

int failed(const std::exception& error, cli::ExitCode code) {
  cli::warn(error.what());
  return code;
}

int run_or_say_why_not(int argc, char** argv) try { return run(argc, argv); } catch (const cli::UsageError& error) {
  return failed(error, cli::kBadUsage);
} catch (const std::system_error& error) {
  if (!std::ferror(stdout)) return failed(error, cli::kFailed);
  errno = error.code().value();  // for is_written(), which says it
  return cli::kFailed;
} catch (const std::exception& error) {
  return failed(error, cli::kFailed);
}

/// Standard output is buffered: that the disk is full may show only at the end. Where a write failed before the end,
/// that was the last thing to set errno, since verbs print last.
bool is_written() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "trivela: cannot write the output: %s\n", std::strerror(errno));
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  trivela::nodes::secure_standard_streams();
  const int exit_code = run_or_say_why_not(argc, argv);
  return is_written() ? exit_code : cli::kFailed;
}
