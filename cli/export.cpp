#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/text/installation.hpp"
#include "evaluator/export/export_files.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

struct ExportFlags {
  std::string log;
  std::string csv;
  std::string mcap;
  evaluator::ExportPlan plan;
  bool force = false;
};

/// A draft can be made beside the folder, and nothing stands in its place.
void require_folder(const std::string& flag, const fs::path& folder, bool force) {
  std::error_code unknown;
  const bool there = fs::exists(fs::symlink_status(folder, unknown));
  if (there && !fs::is_directory(folder, unknown))
    throw UsageError{fmt::format("{} {} is a file, no folder", flag, folder.string())};
  if (there && !force && !fs::is_empty(folder, unknown))
    throw UsageError{
        fmt::format("{} {} is not empty: choose another folder, or --force overwrites its files of the same names",
                    flag, folder.string())};
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
  require_writable(flag, plain.string() + ".new");
  if (there) require_writable(flag, plain / ".new");
}

void require_file(const std::string& flag, const fs::path& file, bool force) {
  std::error_code unknown;
  const bool there = fs::exists(fs::symlink_status(file, unknown));
  if (there && !fs::is_regular_file(file, unknown))
    throw UsageError{fmt::format("{} {} is no file", flag, file.string())};
  if (there && !force)
    throw UsageError{
        fmt::format("{} {} exists already: choose another, or --force overwrites it", flag, file.string())};
  require_writable(flag, file);
  require_writable(flag, file.string() + ".new");
}

std::string told(const std::string& place, const evaluator::ExportedRows& rows) {
  std::int64_t all = 0;
  for (const auto& [stream, n] : rows) all += n;
  return fmt::format("{}: {} rows of {} stream{}\n", place, all, rows.size(), rows.size() == 1 ? "" : "s");
}

int run_export(const ExportFlags& flags) {
  if (flags.csv.empty() && flags.mcap.empty()) throw UsageError{"give --csv FOLDER, --mcap FILE or both"};
  if (!flags.csv.empty()) require_folder("--csv", flags.csv, flags.force);
  if (!flags.mcap.empty()) require_file("--mcap", flags.mcap, flags.force);
  const log::Reader reader(flags.log);
  SignalInbox signals;
  try {
    ProgressBar bar;
    const std::int64_t total = bar.is_seen() ? count_rows(flags.plan, reader) : 0;
    const auto progress = [&](std::int64_t rows) {
      bar.show(static_cast<double>(rows), static_cast<double>(total), "rows", "");
      return !signals.stop_requested();
    };
    if (!flags.mcap.empty())
      say(told(flags.mcap, export_mcap(reader, flags.plan, flags.mcap,
                                       fmt::format("trivela {}", config::software_version()), progress)));
    if (!flags.csv.empty()) say(told(flags.csv, export_csv(reader, flags.plan, flags.csv, progress)));
  } catch (const evaluator::BadExport& bad) {
    throw UsageError{bad.what()};
  } catch (const evaluator::ExportStopped&) {
    warn("interrupted: what was not finished is not there");
    return kFailed;
  }
  for (const std::string& warning : reader.warnings()) warn(warning);
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(app, exit_code, "export",
                                      "Write a match log as CSV, or as MCAP for Foxglove and PlotJuggler", run_export);
  verb->footer(
      R"(A file or folder gets its name when it is whole: nothing half is left behind by Ctrl-C. Streams are the tables
of log/schema/schema.sql; names of columns say the units, NULL is an empty cell, and every number is read
back to the bit. The log is only read.)");
  verb->add_option("log", flags->log, "Match log")->required();
  verb->add_option("--csv", flags->csv, "New folder: a CSV file a stream")->type_name("FOLDER");
  verb->add_option("--mcap", flags->mcap, "New file: all streams in time, with what a 3D view shows")
      ->type_name("FILE");
  verb->add_option("--stream", flags->plan.streams, "Only these, such as kick_decisions,kick_outcomes")->delimiter(',');
  verb->add_option("--session", flags->plan.sessions, "Only sessions whose uuid begins so")->delimiter(',');
  verb->add_flag("--force", flags->force, "Overwrite what is there");
}

}  // namespace trivela::cli
