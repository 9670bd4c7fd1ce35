#include "cli/study_run.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "cli/verbs.hpp"
#include "config/installation.hpp"

namespace trivela::cli {
namespace {

evaluator::log::StudyPlan plan_of(const Study& study, const std::string& verb, const std::string& arguments) {
  const experiment::PlayPlan& plan = study.plan;
  return {.verb = verb,
          .arguments = fmt::format("program = {}\nverb = {}\nseed = {}\nmatches = {}\npossessions = {}\nevenings = {}\n"
                                   "{}",
                                   config::software_version(), verb, plan.seed, plan.matches, plan.possessions,
                                   plan.evenings.size(), arguments),
          .matches = plan.matches,
          .shard = study.shard};
}

/// A file that is not there yet, in this folder.
std::string free_name(const std::string& verb) {
  std::string name = verb + ".tallies.db";
  for (int n = 2; std::filesystem::exists(name); ++n) name = fmt::format("{}-{}.tallies.db", verb, n);
  return name;
}

}  // namespace

StudyRun::StudyRun(const Study& study, const std::string& verb, const std::string& arguments, std::size_t arms)
    : study_(study),
      verb_(verb),
      book_(study.tallies, plan_of(study, verb, arguments)),
      knows_all_(arms > 0),
      expected_(static_cast<double>(arms) * evaluator::log::range_of(study.shard, study.plan.matches).size()) {
  if (const auto there = book_.size(); there > 0 && !study.json)
    fmt::print(stderr, "trivela: {} matches are in {} already\n", there, study.tallies);
}

experiment::KeptPlay StudyRun::play_known(const sim::Scenario& scenario, const std::vector<experiment::Arm>& arms,
                                          const experiment::PlayPlan& plan, const std::string& what) {
  const auto range = evaluator::log::range_of(study_.shard, plan.matches);
  if (!knows_all_) bar_.restart();
  const double before = knows_all_ ? played_ : 0.0;
  return experiment::play_kept(scenario, arms, plan, what, range, book_, [&](std::size_t done, std::size_t all) {
    const auto to_play = static_cast<double>(all);
    if (done == 0)  // what is known already takes no time
      expected_ = knows_all_ ? expected_ - static_cast<double>(arms.size()) * range.size() + to_play : to_play;
    played_ = before + static_cast<double>(done);
    if (all > 0) bar_.show(played_, expected_, "matches", what);
    if (signals_.stop_requested()) throw Interrupted{};
  });
}

void StudyRun::keep() {
  bar_.end();
  book_.commit();
  const auto matches = book_.size();
  if (matches == 0) return warn("interrupted before a match was played");
  if (!study_.tallies.empty())
    return warn(
        fmt::format("interrupted; {} matches are in {}: the same command goes on from there", matches, study_.tallies));
  const std::string name = free_name(verb_);
  book_.save(name);
  warn(fmt::format("interrupted; {0} matches are in {1}: the same command with --tallies {1} goes on from there",
                   matches, name));
}

ExitCode StudyRun::run(const std::function<void()>& play_all, const std::function<void()>& report) {
  try {
    play_all();
  } catch (const Interrupted&) {
    keep();
    return kFailed;
  }
  bar_.end();
  book_.finish();
  if (!study_.shard) {
    report();
    return kDone;
  }
  const auto range = evaluator::log::range_of(study_.shard, study_.plan.matches);
  if (verb_ == "simulate") {
    fmt::print("shard {}: matches {} to {} of {}; trivela merge OUT SHARD... makes one book of all shards\n",
               study_.shard->text(), range.begin, range.end - 1, study_.plan.matches);
    return kDone;
  }
  fmt::print(
      "shard {}: matches {} to {} of {} are in {}; trivela merge OUT SHARD... makes one book of all shards, and "
      "this command with --tallies OUT in place of --shard and its own --tallies the report\n",
      study_.shard->text(), range.begin, range.end - 1, study_.plan.matches, study_.tallies);
  return kDone;
}

}  // namespace trivela::cli
