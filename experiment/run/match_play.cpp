#include "experiment/run/match_play.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <utility>

#include "experiment/run/in_threads.hpp"
#include "kicking/geometry/time.hpp"
#include "robot/recording/message_row.hpp"

namespace trivela::experiment {
namespace {

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + kicking::seconds(now.tv_nsec);
}

std::vector<ArmMatch> play_arms(const ExperimentPlan& plan, std::uint32_t match_id, bool recorded) {
  std::vector<ArmMatch> matches(plan.arms.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Arm arm = plan.in_match(match_id, plan.arms[i]);
    const double before_s = processor_s();
    matches[i].played = play_match(plan.scenario, arm, plan.seed, match_id, plan.possessions, plan.options,
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

template <class T>
std::size_t add_table(log::ExperimentLog& log) {
  return log.table(robot::table_of<T>(), robot::columns_of<T>());
}

}  // namespace

bool play_matches(const ExperimentPlan& plan, std::uint32_t first, bool recorded, const ExperimentWatch& watch,
                  const TakeMatch& take) {
  const auto started = std::chrono::steady_clock::now();
  OrderedMatches matches{first, take};
  try {
    in_threads(
        plan.range().end - first, plan.jobs,
        [&](std::size_t i) {
          const std::uint32_t match_id = first + static_cast<std::uint32_t>(i);
          matches.add(match_id, play_arms(plan, match_id, recorded));
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

MatchTables::MatchTables(log::ExperimentLog& log)
    : log_(log),
      referee_(add_table<msg::Referee>(log)),
      decisions_(add_table<msg::KickDecision>(log)),
      shadows_(log.table(robot::table_of<msg::ShadowDecision>(), robot::shadow_columns())),
      orders_(add_table<msg::KickOrder>(log)),
      receipts_(add_table<msg::KickReceipt>(log)),
      outcomes_(add_table<msg::KickOutcome>(log)),
      estimates_(add_table<msg::KickerEstimate>(log)),
      kick_truths_(add_table<msg::KickTruth>(log)),
      possession_truths_(add_table<msg::PossessionTruth>(log)),
      assignments_(log.table("assignments", robot::assignment_columns())) {}

template <class T>
void MatchTables::write(std::size_t table, const std::vector<T>& messages, std::int64_t session_id) {
  for (const T& message : messages) {
    robot::write_cells(log_.row(table, session_id), message);
    log_.end_row();
  }
}

void MatchTables::write_shadows(const msg::KickDecision& decision, std::int64_t session_id) {
  for (std::int64_t i = 0; i < decision.shadow_count; ++i) {
    robot::write_shadow(log_.row(shadows_, session_id), decision.robot_id, static_cast<std::int64_t>(decision.seq), i,
                        decision.shadows[i]);
    log_.end_row();
  }
}

void MatchTables::write(const MatchRecord& record, std::int64_t session_id) {
  write(referee_, record.referee, session_id);
  write(decisions_, record.decisions, session_id);
  for (const msg::KickDecision& decision : record.decisions) write_shadows(decision, session_id);
  write(orders_, record.orders, session_id);
  write(receipts_, record.receipts, session_id);
  write(outcomes_, record.outcomes, session_id);
  write(estimates_, record.estimates, session_id);
  write(kick_truths_, record.kick_truths, session_id);
  write(possession_truths_, record.possession_truths, session_id);
  for (const Assignment& assignment : record.assignments) {
    robot::write_assignment(log_.row(assignments_, session_id), assignment.robot_id, assignment.half,
                            assignment.possession_id, kicking::name(assignment.policy), assignment.probability,
                            assignment.t_ns);
    log_.end_row();
  }
}

}  // namespace trivela::experiment
