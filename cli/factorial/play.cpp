#include "cli/factorial/play.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "nodes/in_process/play_match.hpp"

namespace trivela::cli {
namespace {

MatchTally tally_of(const nodes::PlayedMatch& match) {
  MatchTally tally;
  for (const nodes::PlayedPossession& possession : match.possessions) {
    ++tally.opportunities;
    if (!possession.kick) continue;
    const nodes::PlayedKick& kick = *possession.kick;
    const bool on_target = kick.observed == kicking::Outcome::kOnTarget;
    ++tally.kicks;
    tally.on_target += on_target ? 1 : 0;
    tally.blocked += kick.observed == kicking::Outcome::kBlocked ? 1 : 0;
    tally.bounced += on_target && kick.truth_bounced ? 1 : 0;
    tally.goals += kick.truth == kicking::Outcome::kOnTarget && !kick.truth_saved ? 1 : 0;
  }
  return tally;
}

}  // namespace

std::vector<std::vector<MatchTally>> play_arms(const sim::Scenario& scenario, const std::vector<nodes::Arm>& arms,
                                               const PlayPlan& plan,
                                               const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::vector<MatchTally>> tallies(arms.size(), std::vector<MatchTally>(plan.matches));
  const std::size_t all = arms.size() * plan.matches;
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < all; i = next++) {
      // Match by match, so that slow arms are spread over the threads.
      const std::size_t arm = i % arms.size(), match = i / arms.size();
      try {
        tallies[arm][match] = tally_of(
            nodes::play_match(scenario, arms[arm], plan.seed, static_cast<std::uint32_t>(match), plan.possessions));
      } catch (...) {
        const std::lock_guard lock{mutex};
        if (!failure) failure = std::current_exception();
        next = all;
        return;
      }
      const std::lock_guard lock{mutex};
      progress(++done, all);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < plan.jobs; ++i) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return tallies;
}

}  // namespace trivela::cli
