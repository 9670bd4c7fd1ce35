#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// What counts as the outcome of a kick on target of which the rules of its session count no goal (view labelled_kicks,
/// log/schema/reading_views.sql), and when that is, in a sentence.
struct NoGoal {
  const char* label;
  const char* where;
};
inline constexpr std::array<NoGoal, 2> kNoGoals{
    {{"own_half", "from the own half"}, {"carried_too_far", "after the ball was carried too far"}}};

inline bool is_no_goal(std::string_view label) {
  return std::ranges::any_of(kNoGoals, [&](const NoGoal& rule) { return label == rule.label; });
}

/// Kicks that were judged by about as many sightings.
struct SightingsRow {
  std::string sightings;
  std::int64_t kicks = 0;
  std::int64_t unknown = 0;
  double expected_wrong = 0.0;  ///< sum of 1 - p of the labels given
};

/// Where balls came back from.
struct TurnCluster {
  double y_m = 0.0;        ///< middle, in F
  std::int64_t turns = 0;  ///< within kTurnReach_m of it
};
inline constexpr double kTurnReach_m = 0.12;

/// Doubt of the labels of a robot's kicks.
struct KickerDoubt {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::string policy;
  stats::LabelDoubt doubt;
};

/// When a robot's balls leave, by their flights.
struct RobotRelease {
  int robot_id = 0;
  std::int64_t kicks = 0;  ///< that were seen to leave
  double late_s = 0.0;     ///< median, after the instant that the robot's file expects
};

/// How far the observed outcomes can be trusted.
struct LabelQuality {
  std::vector<SightingsRow> rows;   ///< "none", "1 to 4", "5 to 9", "10 to 19", "20 or more"
  std::vector<KickerDoubt> doubts;  ///< by session, robot and policy
  std::vector<RobotRelease> releases;
  bool has_probabilities = false;  ///< false: the labels came without them, and count as certain
  std::int64_t stopped_free = 0;   ///< kicks seen flying freely until the game was stopped, before the goal line
  std::int64_t kicks = 0;
  std::optional<double> goal_y_m;        ///< of the robots' settings; none: no kick says it
  std::int64_t turns_at_goal = 0;        ///< balls that came back within 0.3 m of it
  std::optional<TurnCluster> elsewhere;  ///< where most of the others did, if they were four or more

  /// Adds the labels of another log. Goal and releases are each log's own: its warnings say them.
  void add(const LabelQuality& other);

  /// Sentences on tracks that contradict the goal's place; none: they do not.
  std::vector<std::string> goal_warnings() const;
  /// Sentences on robots whose balls leave earlier or later than their files say.
  std::vector<std::string> release_warnings() const;
};

/// Where most of `turns_y_m` lie within kTurnReach_m; none: fewer than four.
std::optional<TurnCluster> densest(std::vector<double> turns_y_m);

LabelQuality label_quality_of(const log::Reader& reader);

/// Labels that people gave kicks that count, beside the observer's outcomes of the same kicks.
struct HandLabels {
  std::int64_t kicks = 0;              ///< with a label by hand
  std::int64_t compared = 0;           ///< of them, those of which both say what became of them
  std::int64_t disagreed = 0;          ///< of those compared, where the two differ
  std::int64_t observer_knew_not = 0;  ///< of the kicks, those of which the observer said nothing or "unknown"

  /// "hand labels: 12 kicks; they disagreed with the observer in 2 of 9, who did not know 3"; empty: there are none.
  std::string line() const;

  void add(const HandLabels& other);
};

/// Whether a label and an observed outcome contradict each other: "outside" is every miss, "goal" and "saved" are on
/// target.
bool disagree(const std::string& by_hand, const std::string& observed);

/// Of kicks in these sessions. Throws std::runtime_error where the log cannot be read.
HandLabels hand_labels_of(const log::Reader& reader, const std::set<std::int64_t>& sessions);

}  // namespace trivela::evaluator
