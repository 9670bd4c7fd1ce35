#include "experiment/run/match_play.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#include "experiment/play/play_match.hpp"
#include "experiment/run/in_threads.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::experiment {
namespace {

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + kicking::seconds(now.tv_nsec);
}

std::vector<ArmMatch> play_arms(const ExperimentPlan& plan, const std::vector<Arm>& arms, std::uint32_t match_id,
                                bool recorded) {
  std::vector<ArmMatch> matches(arms.size());
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const double before_s = processor_s();
    matches[i].played = play_match(plan.scenario, arms[i], plan.seed, match_id, plan.possessions, plan.options,
                                   recorded ? &matches[i].record : nullptr);
    matches[i].processor_s = processor_s() - before_s;
  }
  return matches;
}

/// Somebody asked to stop.
struct Interrupted {};

/// Hands matches on in the order of their numbers. Any thread may add one; one of them hands on at a time, while the
/// others play on.
class OrderedMatches {
 public:
  OrderedMatches(std::uint32_t first, const TakeMatch& take) : next_(first), take_(take) {}

  void add(std::uint32_t match_id, std::vector<ArmMatch> arms) {
    std::unique_lock lock{mutex_};
    waiting_.emplace(match_id, std::move(arms));
    if (std::exchange(taking_, true)) return;
    while (const auto found = waiting_.extract(next_)) {
      lock.unlock();
      take_(found.key(), found.mapped());
      lock.lock();
      ++next_;
    }
    taking_ = false;
  }

 private:
  std::mutex mutex_;
  std::uint32_t next_;
  const TakeMatch& take_;
  std::map<std::uint32_t, std::vector<ArmMatch>> waiting_;
  bool taking_ = false;
};

}  // namespace

bool play_matches(const ExperimentPlan& plan, std::uint32_t first, unsigned jobs, bool recorded,
                  const ExperimentWatch& watch, const TakeMatch& take) {
  const CalibratedArms calibrations{plan.arms, plan.calibrations};
  const auto started = std::chrono::steady_clock::now();
  OrderedMatches matches{first, take};
  try {
    in_threads(
        plan.range().end - first, jobs,
        [&](std::size_t i) {
          const std::uint32_t match_id = first + static_cast<std::uint32_t>(i);
          matches.add(match_id, play_arms(plan, calibrations.of(match_id), match_id, recorded));
        },
        [&](std::size_t done, std::size_t all) {
          const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
          const double opportunities = static_cast<double>(done * plan.possessions * plan.arms.size());
          watch.progress(static_cast<double>(done), static_cast<double>(all),
                         fmt::format("{:.0f} opportunities/s", opportunities / wall.count()));
          if (watch.stop()) throw Interrupted{};
        });
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

}  // namespace trivela::experiment
