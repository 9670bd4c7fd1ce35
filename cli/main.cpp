#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "cli/finite_numbers.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/manual/manual.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "config/error.hpp"
#include "config/installation.hpp"
#include "evaluator/log/log_check.hpp"
#include "evaluator/log/new_file.hpp"
#include "kicking/text/nearest_word.hpp"
#include "nodes/runtime/standard_streams.hpp"

namespace cli = trivela::cli;

namespace {

/// The verbs by what a person wants, in the order of the help.
struct Group {
  const char* wish;
  std::vector<void (*)(CLI::App&, int&)> verbs;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{
      {"Play", {cli::add_match, cli::add_simulate}},
      {"Calibrate", {cli::add_scan, cli::add_lob, cli::add_calibrate}},
      {"Compare", {cli::add_compare, cli::add_factorial, cli::add_frontier, cli::add_sensitivity, cli::add_tune}},
      {"After a match",
       {cli::add_collect, cli::add_merge, cli::add_report, cli::add_drift, cli::add_query, cli::add_export,
        cli::add_import, cli::add_replay, cli::add_evaluate_policy, cli::add_learn, cli::add_label, cli::add_note}},
      {"On the robot",
       {cli::add_team, cli::add_top, cli::add_monitor, cli::add_doctor, cli::add_hardware, cli::add_solve,
        cli::add_align, cli::add_predict, cli::add_refbox, cli::add_emulate, cli::add_keys}}};
  return all;
}

void add_verbs(CLI::App& app, int& exit_code) {
  for (const Group& group : groups()) {
    for (const auto add : group.verbs) {
      add(app, exit_code);
      app.get_subcommands([](const CLI::App*) { return true; }).back()->group(group.wish);
    }
  }
}

/// What is wrong with the first word where a verb of `app` must stand and none does; none: what is wrong is something
/// else.
std::optional<std::string> unknown_verb(const CLI::App& app, int argc, char** argv) {
  const CLI::App* at = &app;
  std::string before;
  for (int i = 1; i < argc; ++i) {
    std::vector<std::string> names;
    for (const CLI::App* verb : at->get_subcommands([](const CLI::App* part) { return !part->get_name().empty(); }))
      names.push_back(verb->get_name());
    if (std::ranges::find(names, argv[i]) == names.end()) {
      if (names.empty() || argv[i][0] == '-') return std::nullopt;
      const auto meant = trivela::kicking::nearest_word(argv[i], names);
      return fmt::format("there is no verb \"{}\"; {}trivela --help names them all", argv[i],
                         meant ? fmt::format("did you mean {}{}? ", before, *meant) : "");
    }
    at = at->get_subcommand(argv[i]);
    before += at->get_name() + ' ';
  }
  return std::nullopt;
}

/// The option that was probably meant by the first word that looks like one and that the verb does not have.
std::optional<std::string> meant_option(const CLI::App& app) {
  const CLI::App* verb = &app;
  while (!verb->get_subcommands().empty()) verb = verb->get_subcommands().front();
  std::vector<std::string> names;
  for (const cli::ManualFlag& flag : cli::verb_tree(*verb).flags)
    names.insert(names.end(), flag.names.begin(), flag.names.end());
  for (const std::string& word : app.remaining(true))
    if (word.starts_with("--")) return trivela::kicking::nearest_word(word.substr(0, word.find('=')), names);
  return std::nullopt;
}

int run(int argc, char** argv) {
  CLI::App app{"Trivela: kick decisions, match logs and their evaluation for robot soccer"};
  app.name("trivela");
  app.require_subcommand(1);
  cli::add_manual_flags(app);
  app.set_version_flag("--version", trivela::config::version_lines("trivela"));
  app.footer(
      "On the robot itself each node is a program of its own, trivela-NODE: see docs/operations.md.\n"
      "Exit codes: 0 done, 1 failed, 2 bad usage, 3 done but a gate missed or data was lost.");
  int exit_code = cli::kDone;
  add_verbs(app, exit_code);
  cli::require_finite_numbers(app);
  if (const auto wrong = unknown_verb(app, argc, argv)) throw cli::UsageError{*wrong};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ExtrasError& error) {
    app.exit(error);
    if (const auto meant = meant_option(app)) cli::warn(fmt::format("did you mean {}?", *meant));
    return cli::kBadUsage;
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

int run_or_say_why_not(int argc, char** argv) try {
  return run(argc, argv);
} catch (const trivela::config::BadArgument& error) {
  return failed(error, cli::kBadUsage);
} catch (const trivela::evaluator::log::FileTaken& error) {
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
  cli::ProgressBar bar;
  trivela::evaluator::log::watch_verification([&](const std::string& file, std::int64_t rows, std::int64_t all) {
    bar.show(static_cast<double>(rows), static_cast<double>(all), "rows", "verified of " + file);
    if (rows >= all) bar.end();
  });
  const int exit_code = run_or_say_why_not(argc, argv);
  return is_written() ? exit_code : cli::kFailed;
}
