#include "cli/study/study.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "evaluator/render/json_values.hpp"

namespace trivela::cli {
namespace {

/// What the rows of a study depend on.
std::string all_arguments_of(const experiment::PlayPlan& plan, const std::string& name, const std::string& arguments) {
  return fmt::format("program = {}\nstudy = {}\nseed = {}\nmatches = {}\npossessions = {}\ncalibrations = {}\n{}",
                     config::software_version(), name, plan.seed, plan.matches, plan.possessions,
                     plan.calibrations.size(), arguments);
}

/// A file that is not there yet, in this folder.
std::string free_name(const std::string& name) {
  std::string file = name + ".results.db";
  for (int n = 2; std::filesystem::exists(file); ++n) file = fmt::format("{}-{}.results.db", name, n);
  return file;
}

void give(const StudyFlags& flags, const experiment::StudyReport& report) {
  flags.json ? fmt::print("{}", evaluator::json_text(report.json)) : say(report.text);
  std::fflush(stdout);
  if (!flags.csv.empty()) write_file(flags.csv, report.csv);
  if (!flags.svg.empty()) write_file(flags.svg, report.svg);
}

void say_part(const StudyFlags& flags) {
  const auto range = log::range_of(flags.plan.shard, flags.plan.matches);
  fmt::print(
      "shard {}: matches {} to {} of {} are in {}. For the report give this command --with and the files of all "
      "shards, in place of --shard and --results\n",
      flags.plan.shard->text(), range.begin, range.end - 1, flags.plan.matches, flags.results);
}

}  // namespace

StudyRun::StudyRun(const StudyFlags& flags, const std::string& name, const std::string& arguments)
    : flags_(flags),
      name_(name),
      results_(flags.results, all_arguments_of(flags.plan, name, arguments), flags.plan.matches) {
  for (const std::string& file : flags.with) results_.take_over(file);
  if (const auto known = results_.size(); known > 0 && !flags.json)
    fmt::print(stderr, "trivela: the results of {} matches are known already\n", known);
}

experiment::KnownPlay StudyRun::play(const std::vector<experiment::StudyWorld>& worlds,
                                     const experiment::PlayPlan& plan) {
  bar_.restart();
  return experiment::play_missing(worlds, plan, results_,
                                  [&](std::size_t done, std::size_t all, const std::string& what) {
                                    if (all > 0)
                                      bar_.show(static_cast<double>(done), static_cast<double>(all), "matches", what);
                                    if (StopRequest::asked()) throw Interrupted{};
                                  });
}

ExitCode StudyRun::keep() {
  bar_.end();
  results_.commit();
  const auto matches = results_.size();
  std::string file = flags_.results;
  if (matches == 0) {
    warn("interrupted before a match was played");
  } else if (!file.empty()) {
    warn(fmt::format("interrupted; {} matches are in {}: the same command goes on from there", matches, file));
  } else {
    file = free_name(name_);
    results_.save(file);
    warn(fmt::format("interrupted; {0} matches are in {1}: the same command with --results {1} goes on from there",
                     matches, file));
  }
  return kFailed;
}

void StudyRun::finish() {
  bar_.end();
  results_.commit(!flags_.plan.shard);
}

ExitCode run_study(StudyFlags flags, const std::function<experiment::Study(const sim::Scenario&)>& make) {
  flags.require_writable();
  const sim::Scenario scenario = flags.world.load();
  const experiment::Study study = make(scenario);
  flags.draw_calibrations(scenario);
  const std::vector<experiment::Arm>& arms = study.worlds.front().arms;
  if (flags.calibrations == 0) warn_of_shared_robots(scenario, arms);
  for (const experiment::Arm& arm : arms) check_playable(scenario, arm, flags.plan.possessions);
  StudyRun run{flags, study.name, arguments_of(study)};
  try {
    auto rows = run.play(study.worlds, flags.plan).rows;
    run.finish();
    flags.plan.shard ? say_part(flags) : give(flags, report_of(study, std::move(rows), flags.played(scenario)));
  } catch (const StudyRun::Interrupted&) {
    return run.keep();
  }
  return kDone;
}

}  // namespace trivela::cli
