#include "cli/study/study_run.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "config/text/installation.hpp"

namespace trivela::cli {
namespace {

log::StudyPlan plan_of(const Study& study, const std::string& name, const std::string& arguments) {
  const experiment::PlayPlan& plan = study.plan;
  return {.arguments = fmt::format("program = {}\nstudy = {}\nseed = {}\nmatches = {}\npossessions = {}\n"
                                   "calibrations = {}\n{}",
                                   config::software_version(), name, plan.seed, plan.matches, plan.possessions,
                                   plan.calibrations.size(), arguments),
          .matches = plan.matches,
          .shard = study.shard};
}

/// A file that is not there yet, in this folder.
std::string free_name(const std::string& name) {
  std::string file = name + ".results.db";
  for (int n = 2; std::filesystem::exists(file); ++n) file = fmt::format("{}-{}.results.db", name, n);
  return file;
}

}  // namespace

StudyRun::StudyRun(const Study& study, const std::string& name, const std::string& arguments, std::size_t arms)
    : study_(study),
      name_(name),
      results_(study.results, plan_of(study, name, arguments)),
      knows_all_(arms > 0),
      expected_(static_cast<double>(arms) * log::range_of(study.shard, study.plan.matches).size()) {
  for (const std::string& file : study.with) results_.take_over(file);
  if (const auto known = results_.size(); known > 0 && !study.json)
    fmt::print(stderr, "trivela: the results of {} matches are known already\n", known);
}

experiment::KnownPlay StudyRun::play_known(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms,
                                           const experiment::PlayPlan& plan, const std::string& what) {
  const auto range = log::range_of(study_.shard, plan.matches);
  if (!knows_all_) bar_.restart();
  const double before = knows_all_ ? played_ : 0.0;
  return experiment::play_missing(scenario, arms, plan, what, range, results_, [&](std::size_t done, std::size_t all) {
    const auto to_play = static_cast<double>(all);
    if (done == 0)  // what is known already takes no time
      expected_ = knows_all_ ? expected_ - static_cast<double>(arms.size()) * range.size() + to_play : to_play;
    played_ = before + static_cast<double>(done);
    if (all > 0) bar_.show(played_, expected_, "matches", what);
    if (StopRequest::asked()) throw Interrupted{};
  });
}

void StudyRun::keep() {
  bar_.end();
  results_.commit();
  const auto matches = results_.size();
  if (matches == 0) return warn("interrupted before a match was played");
  if (!study_.results.empty())
    return warn(
        fmt::format("interrupted; {} matches are in {}: the same command goes on from there", matches, study_.results));
  const std::string file = free_name(name_);
  results_.save(file);
  warn(fmt::format("interrupted; {0} matches are in {1}: the same command with --results {1} goes on from there",
                   matches, file));
}

ExitCode StudyRun::run(const std::function<void()>& play_all, const std::function<void()>& report) {
  try {
    play_all();
  } catch (const Interrupted&) {
    keep();
    return kFailed;
  }
  bar_.end();
  results_.finish();
  if (!study_.shard) {
    report();
    return kDone;
  }
  const auto range = log::range_of(study_.shard, study_.plan.matches);
  fmt::print(
      "shard {}: matches {} to {} of {} are in {}. For the report give this command --with and the files of all "
      "shards, "
      "in place of --shard and --results\n",
      study_.shard->text(), range.begin, range.end - 1, study_.plan.matches, study_.results);
  return kDone;
}

}  // namespace trivela::cli
