#include "evaluator/table2/report_parts.hpp"

#include <map>
#include <set>
#include <tuple>
#include <unordered_set>

#include "evaluator/counting/kick_counts.hpp"
#include "evaluator/counting/policy_order.hpp"
#include "evaluator/stats/clustered.hpp"

namespace trivela::evaluator {
namespace {

constexpr int kAllRobots = -1;  // 0 is a robot that an import does not know

struct RowKey {
  int robot_id = kAllRobots;
  std::size_t arm = 0;  // place in the arms + 1; 0: none
  std::string policy;

  bool operator<(const RowKey& other) const {
    if (std::tie(robot_id, arm) != std::tie(other.robot_id, other.arm))
      return std::tie(robot_id, arm) < std::tie(other.robot_id, other.arm);
    return PolicyOrder{}(policy, other.policy);
  }
};

/// Rows by robot, and of all robots together.
class Rows {
 public:
  explicit Rows(const Arms& arms) : arms_(arms) {}

  RowKey key(int robot_id, std::int64_t session_id, const std::string& policy) const {
    const auto arm = arms_.of_session.find(session_id);
    return {robot_id, arm == arms_.of_session.end() ? 0 : arm->second + 1, policy};
  }

  RobotRow& operator[](const RowKey& key) { return rows_[key]; }

  /// Calls `fn` with the robot's row, and with that of all robots.
  void of_both(int robot_id, std::int64_t session_id, const std::string& policy, const auto& fn) {
    fn(rows_[key(kAllRobots, session_id, policy)]);
    fn(rows_[key(robot_id, session_id, policy)]);
  }

  ReportRows finish(bool blocked_apart) && {
    ReportRows result;
    std::set<int> robots;
    for (auto& [key, row] : rows_) {
      row.robot_id = key.robot_id;
      row.policy = key.policy;
      row.arm = key.arm == 0 ? "" : arms_.all[key.arm - 1].name;
      row.beside_arms = key.arm == 0 && !arms_.all.empty();
      row.blocked_apart = blocked_apart;
      if (key.robot_id != kAllRobots) robots.insert(key.robot_id);
    }
    result.robot_ids.assign(robots.begin(), robots.end());
    for (auto& [key, row] : rows_) {
      if (key.robot_id == kAllRobots) {
        result.policies.push_back(std::move(row));
      } else if (robots.size() > 1) {
        result.robots.push_back(std::move(row));
      }
    }
    return result;
  }

 private:
  const Arms& arms_;
  std::map<RowKey, RobotRow> rows_;
};

// Each policy has its row, whether it kicked or not.
void enter_policies(Rows& rows, const CountedLogs& logs) {
  std::unordered_set<std::int64_t> counted;
  for (const ComparedSession& session : logs.logged.sessions)
    if (session.counts) counted.insert(session.session_id);
  for (const log::RecordedSession& session : logs.sessions) {
    if (!counted.contains(session.session_id)) continue;
    for (const log::HalfPolicy& half : session.policies) rows[rows.key(kAllRobots, session.session_id, half.policy)];
  }
}

void add_minutes(Rows& rows, const LoggedOpportunities& logged) {
  const auto add = [&](const RowKey& key, double minutes) {
    auto& sum = rows[key].played_min;
    sum = sum.value_or(0.0) + minutes;
  };
  for (const PlayedSpan& span : logged.spans) {
    const std::int64_t session_id = logged.sessions[span.session].session_id;
    std::set<std::string> policies;
    for (const PolicyOfRobot& who : span.had_it) {
      policies.insert(who.policy);
      if (who.robot_id != 0) add(rows.key(who.robot_id, session_id, who.policy), span.minutes);
    }
    policies.erase("");
    for (const std::string& policy : policies) add(rows.key(kAllRobots, session_id, policy), span.minutes);
  }
}

// Where the minutes of some of the kicks are not known, those of the others make no rate.
void add_kicks(Rows& rows, const LoggedOpportunities& logged) {
  std::set<std::uint32_t> timed;  // plays
  for (const PlayedSpan& span : logged.spans) timed.insert(logged.sessions[span.session].play);
  for (const CountedKick& kick : logged.kicks) {
    const bool has_minutes = timed.contains(logged.sessions[kick.session].play);
    rows.of_both(kick.robot_id, logged.sessions[kick.session].session_id, kick.policy, [&](RobotRow& row) {
      row.add(kick.outcome.empty() ? "unknown" : kick.outcome, kick.said);
      if (!has_minutes) row.played_min.reset();
    });
  }
}

// Situations of paired halves are one thing each, however many halves had them.
void allow_for_paired_halves(Rows& rows, const LoggedOpportunities& logged) {
  using PlayedSituation =
      std::tuple<std::uint32_t, std::uint32_t, int, int, std::int64_t>;  // match, play, robot, half, id
  std::map<RowKey, std::map<PlayedSituation, stats::Counts>> situations;
  for (const LoggedOpportunity& o : logged.rows) {
    if (o.ending != Ending::kInside && o.ending != Ending::kOutside) continue;
    const ComparedSession& session = logged.sessions[o.session];
    const int half = session.paired_halves && o.possession_id != 0 ? 0 : o.half;
    for (const int robot_id : {kAllRobots, o.robot_id}) {
      const RowKey key = rows.key(robot_id, session.session_id, o.policy);
      stats::Counts& counts = situations[key][{session.match, session.play, o.robot_id, half, o.possession_id}];
      if (half == 0 && counts.n > 0) ++rows[key].repeated;
      add(counts, o.ending);
    }
  }
  for (const auto& [key, by_situation] : situations) {
    RobotRow& row = rows[key];
    if (row.repeated == 0) continue;
    std::vector<stats::Counts> counts;
    for (const auto& [situation, of] : by_situation) counts.push_back(of);
    row.paired_ci = stats::clustered_wilson(counts);
  }
}

}  // namespace

ReportRows report_rows(const CountedLogs& logs, bool blocked_apart) {
  Rows rows(logs.arms);
  enter_policies(rows, logs);
  add_minutes(rows, logs.logged);
  add_kicks(rows, logs.logged);
  allow_for_paired_halves(rows, logs.logged);
  for (const KickerDoubt& doubt : logs.doubts)
    rows.of_both(doubt.robot_id, doubt.session_id, doubt.policy, [&](RobotRow& row) { row.doubt += doubt.doubt; });
  return std::move(rows).finish(blocked_apart);
}

}  // namespace trivela::evaluator
