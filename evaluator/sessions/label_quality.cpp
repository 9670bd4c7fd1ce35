#include "evaluator/sessions/label_quality.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "evaluator/metrics/label_doubt.sql.hpp"
#include "evaluator/metrics/labels_by_hand.sql.hpp"
#include "log/file/session_tallies.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::int64_t kManyTurns = 4;
constexpr std::int64_t kManySightings = 10;  // by which a block would have been seen
constexpr double kNearGoal_m = 0.3;
constexpr std::int64_t kManyReleases = 8;
constexpr double kWrongDelay_s = 0.03;  // a robot that turns with 2 rad/s points 3.4 degrees further then

constexpr std::array<std::pair<std::int64_t, const char*>, 5> kRows{
    {{0, "none"}, {4, "1 to 4"}, {9, "5 to 9"}, {19, "10 to 19"}, {INT64_MAX, "20 or more"}}};

void read_labels(const log::Reader& reader, LabelQuality& quality) {
  for (const auto& [most, name] : kRows) quality.rows.push_back({.sightings = name});
  std::map<std::tuple<std::int64_t, int, std::string>, stats::LabelDoubt> doubts;
  std::map<int, std::vector<double>> late_s;  // by robot
  const auto add = [&](const log::NamedCells& row) {
    const auto& label = row.get<std::string>("outcome");
    const auto sightings = row.get<std::int64_t>("observations");
    const auto p_inside = row.find<double>("p_on_target");
    const auto p_any = row.find<double>("p_of_any");
    if (const auto late = row.find<double>("release_late_s")) late_s[row.get<int>("robot_id")].push_back(*late);
    const auto place = std::ranges::find_if(kRows, [&](const auto& r) { return sightings <= r.first; });
    SightingsRow& of = quality.rows[static_cast<std::size_t>(place - kRows.begin())];
    const bool unknown = label == "unknown";
    ++quality.kicks;
    ++of.kicks;
    of.unknown += unknown ? 1 : 0;
    quality.has_probabilities = quality.has_probabilities || p_any.has_value();
    if (unknown) {
      quality.stopped_free += p_any && 1.0 - *p_any > 0.3 && sightings >= kManySightings ? 1 : 0;
      return;
    }
    of.expected_wrong += 1.0 - row.find<double>("p_of_label").value_or(1.0);
    stats::LabelDoubt& doubt =
        doubts[{row.get<std::int64_t>("session_id"), row.get<int>("robot_id"), row.get<std::string>("policy")}];
    if (label == "on_target") {
      doubt.inside += 1.0 - p_inside.value_or(1.0);
    } else if (!is_no_goal(label)) {  // however sure it is that it was inside
      doubt.outside += p_inside.value_or(0.0);
    }
  };
  reader.query(kLabelDoubtSql, add);
  for (auto& [robot_id, late] : late_s) {
    const auto middle = late.begin() + static_cast<std::ptrdiff_t>(late.size() / 2);
    std::ranges::nth_element(late, middle);
    quality.releases.push_back({robot_id, static_cast<std::int64_t>(late.size()), *middle});
  }
  for (const auto& [key, doubt] : doubts)
    quality.doubts.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), doubt});
}

void read_turns(const log::Reader& reader, LabelQuality& quality) {
  reader.query("SELECT max(target_y_m) FROM (SELECT target_y_m FROM kick_decisions LIMIT 1000)",
               [&](std::optional<double> goal_y_m) { quality.goal_y_m = goal_y_m; });
  if (!quality.goal_y_m) return;
  std::vector<double> away = log::ball_turns_of(reader);
  const auto at_goal = std::erase_if(away, [&](double y_m) { return std::abs(y_m - *quality.goal_y_m) < kNearGoal_m; });
  quality.turns_at_goal = static_cast<std::int64_t>(at_goal);
  quality.elsewhere = densest(std::move(away));
}

}  // namespace

std::optional<TurnCluster> densest(std::vector<double> turns_y_m) {
  std::ranges::sort(turns_y_m);
  std::optional<TurnCluster> best;
  for (std::size_t first = 0, last = 0; last < turns_y_m.size(); ++last) {
    while (turns_y_m[last] - turns_y_m[first] > 2.0 * kTurnReach_m) ++first;
    const auto n = static_cast<std::int64_t>(last - first + 1);
    if (n >= kManyTurns && (!best || n > best->turns)) best = TurnCluster{turns_y_m[first + (last - first) / 2], n};
  }
  return best;
}

void LabelQuality::add(const LabelQuality& other) {
  if (rows.empty()) rows.resize(other.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].sightings = other.rows[i].sightings;
    rows[i].kicks += other.rows[i].kicks;
    rows[i].unknown += other.rows[i].unknown;
    rows[i].expected_wrong += other.rows[i].expected_wrong;
  }
  doubts.insert(doubts.end(), other.doubts.begin(), other.doubts.end());
  has_probabilities = has_probabilities || other.has_probabilities;
  stopped_free += other.stopped_free;
  kicks += other.kicks;
}

std::vector<std::string> LabelQuality::goal_warnings() const {
  std::vector<std::string> warnings;
  if (goal_y_m && elsewhere && elsewhere->turns > turns_at_goal) {
    warnings.push_back(
        fmt::format("{} balls came back from y = {:.2f} m within {:.2f} m of each other, {} from the goal line at "
                    "goal.y_m = {:.2f} m: is the goal where the settings have it?",
                    elsewhere->turns, elsewhere->y_m, kTurnReach_m, turns_at_goal, *goal_y_m));
  }
  if (stopped_free >= 3 && 10 * stopped_free >= kicks) {
    warnings.push_back(
        fmt::format("{} of {} kicks were seen flying freely until the game was stopped, before they reached the goal "
                    "line{}: is the goal where the settings have it?",
                    stopped_free, kicks, goal_y_m ? fmt::format(" at goal.y_m = {:.2f} m", *goal_y_m) : ""));
  }
  return warnings;
}

std::vector<std::string> LabelQuality::release_warnings() const {
  std::vector<std::string> warnings;
  for (const RobotRelease& robot : releases) {
    if (robot.kicks < kManyReleases || std::abs(robot.late_s) < kWrongDelay_s) continue;
    warnings.push_back(
        fmt::format("robot {}: the ball leaves {:.2f} s {} than its file says (median of {} kicks): measure "
                    "kicker.delay_s (trivela calibrate run)",
                    robot.robot_id, std::abs(robot.late_s), robot.late_s > 0.0 ? "later" : "earlier", robot.kicks));
  }
  return warnings;
}

LabelQuality label_quality_of(const log::Reader& reader) {
  LabelQuality quality;
  read_labels(reader, quality);
  read_turns(reader, quality);
  return quality;
}

bool disagree(const std::string& by_hand, const std::string& observed) {
  const auto on_target = [](const std::string& outcome) {
    return outcome == "goal" || outcome == "saved" || outcome == "on_target";
  };
  if (by_hand == "outside") return on_target(observed);
  if (!on_target(by_hand) || !on_target(observed)) return by_hand != observed;
  return by_hand != observed && by_hand != "on_target" && observed != "on_target";
}

HandLabels hand_labels_of(const log::Reader& reader, const std::set<std::int64_t>& sessions) {
  HandLabels labels;
  reader.query(kLabelsByHandSql, [&](const log::NamedCells& row) {
    const auto& outcome = row.get<std::string>("outcome");
    const auto observed = row.find<std::string>("observed");
    if (!sessions.contains(row.get<std::int64_t>("session_id"))) return;
    ++labels.kicks;
    if (!observed || *observed == "unknown") {
      ++labels.observer_knew_not;
    } else if (outcome != "unknown") {
      ++labels.compared;
      labels.disagreed += disagree(outcome, *observed) ? 1 : 0;
    }
  });
  return labels;
}

void HandLabels::add(const HandLabels& other) {
  kicks += other.kicks;
  compared += other.compared;
  disagreed += other.disagreed;
  observer_knew_not += other.observer_knew_not;
}

std::string HandLabels::line() const {
  if (kicks == 0) return "";
  return fmt::format("hand labels: {} kick{}; they disagreed with the observer in {} of {}, who did not know {}", kicks,
                     kicks == 1 ? "" : "s", disagreed, compared, observer_knew_not);
}

}  // namespace trivela::evaluator
