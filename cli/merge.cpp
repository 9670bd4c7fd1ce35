#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/launch/progress_bar.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/sessions/merge_report.hpp"
#include "log/file/log_file.hpp"
#include "log/file/new_file.hpp"
#include "log/merge/merge.hpp"
#include "log/shards/shards.hpp"

namespace trivela::cli {
namespace {

struct MergeArguments {
  std::string out;
  std::vector<std::string> logs;
  std::optional<int> reference_robot;
};

/// Shows how many rows are copied; the line ends when the function is destroyed.
std::function<bool(std::int64_t, std::int64_t)> copied() {
  return [bar = std::make_shared<StoppableBar>()](std::int64_t read, std::int64_t all) {
    return bar->show(static_cast<double>(read), static_cast<double>(all), "rows", "copied");
  };
}

int merge_shards(const MergeArguments& arguments, const std::vector<std::filesystem::path>& shards) {
  if (arguments.reference_robot) throw UsageError{"--reference: shards of an experiment have one clock"};
  const auto merged = log::merge_shards(shards, arguments.out, copied());
  say(fmt::format("{}: {} sessions of {} matches, of {} shards\nmissing: nothing\n", arguments.out, merged.sessions,
                  merged.matches, merged.shards));
  return kDone;
}

/// A mistyped name is no damage: throws log::NoSuchLog for the first that is no match log, sound or not.
void require_match_logs(const std::vector<std::filesystem::path>& logs) {
  for (const std::filesystem::path& log : logs) {
    try {
      const log::Reader reader(log, log::Check::kSchema);
    } catch (const log::NoSuchLog&) {
      throw;
    } catch (const std::exception&) {  // merging takes what can be read, and says what is wrong with the rest
    }
  }
}

int run_merge(const MergeArguments& arguments) try {
  require_new("OUT", arguments.out);
  const std::vector<std::filesystem::path> logs{arguments.logs.begin(), arguments.logs.end()};
  if (log::any_is_shard(logs)) return merge_shards(arguments, logs);
  require_match_logs(logs);
  const log::Merged merged =
      log::merge(logs, arguments.out, {.reference_robot = arguments.reference_robot, .progress = copied()});
  if (arguments.reference_robot && !merged.alignment.reference_robot)
    warn(fmt::format("no clock was measured against that of robot {}", *arguments.reference_robot));
  const evaluator::MergeReport report = evaluator::report_merge(merged, log::Reader(arguments.out, log::Check::kQuick));
  say(fmt::format("{}\n{}: {}\n", report.table, arguments.out, report.total));
  for (const std::string& note : report.notes) say(note + '\n');
  if (!report.conflicts.empty()) {
    say("conflicts, of which the more complete recording counts, of labels the latest:\n");
    for (const std::string& line : report.conflicts) say("  " + line + '\n');
  }
  if (report.missing.empty()) {
    say("missing: nothing\n");
    return report.conflicts.empty() ? kDone : kDoneWithLoss;
  }
  say("missing:\n");
  for (const std::string& line : report.missing) say("  " + line + '\n');
  return kDoneWithLoss;
} catch (const log::Stopped&) {
  warn(fmt::format("interrupted: there is no {}", arguments.out));
  return kFailed;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "merge", "Make one match log of those of a team's robots, or of an experiment's shards",
               run_merge);
  verb->footer(
      "Every session comes along once, row for row; verbs count each kick once. Times are aligned by the clock "
      "offsets\n"
      "that the robots measured. Of a damaged file what can be read is taken; one that is no match log is refused. No "
      "file is changed. Ends with\n"
      "\"missing: nothing\", or with what is missing and exit code 3, as where two files say different things of a "
      "kick. Shards of an experiment (trivela simulate --shard)\n"
      "become the log that one run writes; a shard that lacks, is not finished or of another experiment is refused.");
  verb->add_option("out", arguments->out, "The new log, must not exist")->required();
  verb->add_option("logs", arguments->logs, "Match logs, merged ones, too")->required();
  verb->add_option(
          "--reference", arguments->reference_robot,
          "Robot by whose clock times are aligned, 0: the base's; without: the one that most were measured against")
      ->check(CLI::Range(0, 255));
}

}  // namespace trivela::cli
