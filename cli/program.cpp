#include "cli/program.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "cli/launch/progress_bar.hpp"
#include "cli/manual/manual.hpp"
#include "cli/options/output.hpp"
#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "config/text/parse_number.hpp"
#include "kicking/text/nearest_word.hpp"
#include "log/file/log_check.hpp"
#include "log/file/new_file.hpp"
#include "nodes/runtime/standard_streams.hpp"

namespace trivela::cli {
namespace {

/// Lets every number with a fraction that `verb` and its subcommands take be finite: CLI11 reads "nan" and "inf", and
/// its ranges let NaN through. Call it when all flags are there.
void require_finite_numbers(CLI::App& verb) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto value = config::parse_number(text);
    return value && !std::isfinite(*value) ? text + " is not a finite number" : "";
  };
  for (CLI::Option* option : verb.get_options()) {
    if (option->get_type_name().starts_with(CLI::detail::type_name<double>())) option->check(problem);
  }
  for (CLI::App* part : verb.get_subcommands(nullptr)) require_finite_numbers(*part);
}

/// Where verbs write, as positional or flag: one file each.
constexpr std::array<std::string_view, 13> kOutputs{"out",    "out-dir",    "html",  "csv",     "svg", "plot", "mcap",
                                                    "record", "synthesize", "truth", "results", "dir", "to"};

void find_outputs(CLI::App& verb, std::vector<CLI::Option*>& outputs) {
  for (CLI::Option* option : verb.get_options()) {
    if (option->get_items_expected_max() == 1 && std::ranges::count(kOutputs, option->get_single_name()) > 0)
      outputs.push_back(option);
  }
  for (CLI::App* part : verb.get_subcommands(nullptr)) find_outputs(*part, outputs);
}

/// Lets every output of a command line have a name, and no two the same: one of them would be lost. Call it when all
/// flags are there.
void require_own_outputs(CLI::App& app) {
  std::vector<CLI::Option*> outputs;
  find_outputs(app, outputs);
  const auto place = [](const std::string& file) {
    return std::filesystem::weakly_canonical(std::filesystem::current_path() / file);
  };
  for (CLI::Option* output : outputs) {
    output->check([=](const std::string& file) -> std::string {
      if (file.empty()) return "needs a name";
      for (const CLI::Option* other : outputs) {
        if (other != output && !other->empty() && place(other->results().front()) == place(file))
          return fmt::format("the same file as {}: {}", other->get_name(), file);
      }
      return {};
    });
  }
}

void add_verbs(CLI::App& app, const std::vector<VerbGroup>& groups, int& exit_code) {
  for (const VerbGroup& group : groups) {
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
      const auto meant = kicking::nearest_word(argv[i], names);
      return fmt::format("there is no verb \"{}\"; {}{} --help names them all", argv[i],
                         meant ? fmt::format("did you mean {}{}? ", before, *meant) : "", app.get_name());
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
  for (const ManualFlag& flag : verb_tree(*verb).flags) names.insert(names.end(), flag.names.begin(), flag.names.end());
  for (const std::string& word : app.remaining(true))
    if (word.starts_with("--")) return kicking::nearest_word(word.substr(0, word.find('=')), names);
  return std::nullopt;
}

int run(const ProgramInfo& program, int argc, char** argv) {
  CLI::App app{program.what};
  app.name(program.name);
  app.require_subcommand(1);
  if (program.has_manual) add_manual_flags(app);
  app.set_version_flag("--version", config::version_lines(program.name));
  app.footer(program.footer);
  int exit_code = kDone;
  add_verbs(app, program.verbs, exit_code);
  require_finite_numbers(app);
  require_own_outputs(app);
  if (const auto wrong = unknown_verb(app, argc, argv)) throw UsageError{*wrong};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ExtrasError& error) {
    app.exit(error);
    if (const auto meant = meant_option(app)) warn(fmt::format("did you mean {}?", *meant));
    return kBadUsage;
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return kBadUsage;
  }
  return exit_code;
}

int failed(const std::exception& error, ExitCode code) {
  warn(error.what());
  return code;
}

int run_or_say_why_not(const ProgramInfo& program, int argc, char** argv) try {
  return run(program, argc, argv);
} catch (const config::BadArgument& error) {
  return failed(error, kBadUsage);
} catch (const log::FileTaken& error) {
  return failed(error, kBadUsage);
} catch (const std::system_error& error) {
  if (!std::ferror(stdout)) return failed(error, kFailed);
  errno = error.code().value();  // for is_written(), which says it
  return kFailed;
} catch (const std::exception& error) {
  return failed(error, kFailed);
}

/// Standard output is buffered: that the disk is full may show only at the end. Where a write failed before the end,
/// that was the last thing to set errno, since verbs print last.
bool is_written() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "trivela: cannot write the output: %s\n", std::strerror(errno));
  return false;
}

}  // namespace

int run_program(const ProgramInfo& program, int argc, char** argv) {
  nodes::secure_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // at a limit of `ulimit -f` a write fails, as on a full disk
  ProgressBar bar;
  log::watch_verification([&](const std::string& file, std::int64_t rows, std::int64_t all) {
    bar.show(static_cast<double>(rows), static_cast<double>(all), "rows", "verified of " + file);
    if (rows >= all) bar.end();
  });
  const int exit_code = run_or_say_why_not(program, argc, argv);
  return is_written() ? exit_code : kFailed;
}

}  // namespace trivela::cli
