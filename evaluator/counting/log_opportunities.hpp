#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/counting/kick_dataset.hpp"
#include "evaluator/sessions/same_match.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A robot with the policy that was in charge of it.
struct PolicyOfRobot {
  int robot_id = 0;
  std::string policy;  ///< empty: not known

  auto operator<=>(const PolicyOfRobot&) const = default;  // NOLINT(modernize-use-nullptr): the 0 is the compiler's
};

/// What the robot believed when it first had to decide in a possession.
struct FirstDecision {
  double distance_m = 0.0;  ///< ball to target
  double x_m = 0.0;         ///< of the robot, to the right of the goal's middle
  std::optional<double> opponent_distance_m;
};

/// An opportunity as a log has it; also a kick whose possession is not known.
struct LoggedOpportunity {
  std::uint32_t session = 0;  ///< place in the sessions
  int robot_id = 0;
  int half = 0;
  std::int64_t possession_id = 0;
  std::string policy;
  std::optional<double> probability;       ///< with which the policy was put in charge
  std::optional<double> start_distance_m;  ///< robot to the middle of the goal at the start, by the simulator's truth
  std::optional<double> start_x_m;         ///< to the right of the goal's middle at the start, by the same
  std::optional<double> distance_m;        ///< ball to target at the kick, as the robot believed; none: no kick
  std::optional<FirstDecision> first;      ///< none: the log has not every cycle
  Ending ending = Ending::kNoKick;
  double doubt = 0.0;    ///< probability that a kick called inside was not, or one called outside was
  bool blocked = false;  ///< the kick, an Ending::kOutside
  ReportsOfKick said{};
  bool has_possession = true;  ///< false: a kick alone
};

/// A kick that counts: a row of compared_kicks.sql.
struct CountedKick {
  std::uint32_t session = 0;  ///< place in the sessions
  int robot_id = 0;
  int half = 0;
  std::int64_t possession_id = 0;
  std::string policy;
  std::string outcome;  ///< its label, by what the logs were read for; empty: not known
  std::optional<double> distance_m;
  std::int64_t kick_id = 0;
  std::optional<double> p_inside;  ///< of the observed label; none where the truth is asked for
  ReportsOfKick said{};
};

/// Play while a possession lasted.
struct PlayedSpan {
  std::uint32_t session = 0;  ///< place in the sessions; of several recordings of a play the first
  int half = 0;
  double minutes = 0.0;
  std::vector<PolicyOfRobot> had_it;  ///< robots that had the ball in it, each with its policy; empty: nobody is known
};

/// What logs know of opportunities and kicks, their sessions merged.
struct LoggedOpportunities {
  std::vector<std::string> logs;  ///< their names, in the order of reading
  std::vector<ComparedSession> sessions;
  std::vector<LoggedOpportunity> rows;
  std::vector<CountedKick> kicks;  ///< of two in a possession its row has the later one
  std::vector<PlayedSpan> spans;
  std::uint32_t matches = 0;
  std::int64_t draws_of_halves = 0;      ///< policies drawn where nobody counted possessions: one a half
  std::vector<std::string> not_counted;  ///< sentences on what does not count, or not twice
  std::vector<std::string> remarks;      ///< these, and sentences on sessions that were not closed and on loss
};

/// Sessions are one match that have the same match_id or seed and world; recorded on robots: that overlap in time. A
/// session that stands in several logs counts once, and so does what several sessions recorded of one play, as
/// find_plays() says. Throws std::runtime_error where a log cannot be read, or the logs hold replays alone.
LoggedOpportunities read_opportunities(const std::vector<std::filesystem::path>& logs, bool truth);

/// A log that is open, and what sentences call it.
struct OpenLog {
  log::Reader* reader = nullptr;
  std::string name;
};

/// The same of open logs, replays alone too; each reader's counted_kicks has from then on what counts, and what an
/// earlier log has does not count again.
LoggedOpportunities read_opportunities(std::span<const OpenLog> logs, bool truth);
LoggedOpportunities read_opportunities(log::Reader& reader, const std::string& name, bool truth);

}  // namespace trivela::evaluator
