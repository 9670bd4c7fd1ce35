#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/launch/progress_bar.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/log/migration.hpp"
#include "evaluator/log/reader.hpp"

namespace trivela::cli {
namespace {

struct MigrateArguments {
  std::string log;
  std::string out;
};

}  // namespace

void add_migrate(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("migrate", "Copy a match log of an older version to one of this version");
  verb->footer(
      "The old log is verified first and stays as it is; the new one has digests of its own. Nobody needs it to\n"
      "read an older log: every verb does.");
  const auto arguments = std::make_shared<MigrateArguments>();
  verb->add_option("log", arguments->log, "Match log of any version")->required();
  verb->add_option("--out", arguments->out, "The new log, must not exist")->required();
  verb->callback([arguments, &exit_code] {
    require_new("--out", arguments->out);
    const auto migrated = [&] {
      ProgressBar bar;
      return evaluator::log::migrate(arguments->log, arguments->out, [&](std::int64_t rows, std::int64_t total) {
        bar.show(static_cast<double>(rows), static_cast<double>(total), "rows", "");
      });
    }();
    say(fmt::format("{}: {} rows of version {}, {} new digest{}\n", arguments->out, migrated.rows,
                    migrated.from_version, migrated.sessions, migrated.sessions == 1 ? "" : "s"));
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
