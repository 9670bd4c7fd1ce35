#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "cli/launch/stoppable_bar.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/log/migration.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/log/stoppable.hpp"

namespace trivela::cli {
namespace {

struct MigrateArguments {
  std::string log;
  std::string out;
  bool in_place = false;
};

int run_migrate(const MigrateArguments& arguments) try {
  if (arguments.out.empty() && !arguments.in_place) throw UsageError{"say --out NEW or --in-place"};
  const std::filesystem::path backup =
      arguments.in_place ? evaluator::log::backup_of(arguments.log) : std::filesystem::path{};
  const auto migrated = [&] {
    StoppableBar bar;
    const auto progress = [&](std::int64_t rows, std::int64_t total) {
      return bar.show(static_cast<double>(rows), static_cast<double>(total), "rows", "");
    };
    return arguments.in_place ? evaluator::log::migrate_in_place(arguments.log, backup, progress)
                              : evaluator::log::migrate(arguments.log, arguments.out, progress);
  }();
  say(fmt::format("{}: {} rows of version {}, {} new digest{}\n", arguments.in_place ? arguments.log : arguments.out,
                  migrated.rows, migrated.from_version, migrated.sessions, migrated.sessions == 1 ? "" : "s"));
  if (arguments.in_place) say(fmt::format("the old log is {}\n", backup.string()));
  return kDone;
} catch (const evaluator::log::Stopped&) {
  warn(arguments.in_place ? fmt::format("interrupted: {} is as it was", arguments.log)
                          : fmt::format("interrupted: there is no {}", arguments.out));
  return kFailed;
}

}  // namespace

void add_migrate(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("migrate", "Make a match log of this version of an older one");
  verb->footer(
      "The old log is verified first and stays as it is; the new one has digests of its own. Nobody needs it to\n"
      "read an older log: every verb does; label and note add to logs of this version alone. --in-place puts the new\n"
      "log in the old one's place and keeps the old file beside it, as NAME.version-N.db.");
  const auto arguments = std::make_shared<MigrateArguments>();
  verb->add_option("log", arguments->log, "Match log of any version")->required();
  auto* const out = verb->add_option("--out", arguments->out, "The new log, must not exist");
  verb->add_flag("--in-place", arguments->in_place, "Keep the old log as NAME.version-N.db and take its name")
      ->excludes(out);
  verb->callback([arguments, &exit_code] { exit_code = run_migrate(*arguments); });
}

}  // namespace trivela::cli
