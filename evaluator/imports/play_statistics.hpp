#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluator/imports/referee_log.hpp"
#include "evaluator/imports/team_log.hpp"

namespace trivela::evaluator::imports {

/// When each usable record was true, UTC since 1970 [ms], never falling: records count in the order of the file, and
/// the step between two is that of the box's game time. Where the game time falls back a new part began. A part's place
/// in UTC is the median of `timestamp - gametimeMs` over the records whose timestamp moved on; where none did, what the
/// referee's log says of its parts, one after the other; otherwise it follows its predecessor at once. A record
/// without game time, or with that of its predecessor, is as much later as its timestamp moved, at most 2 s.
std::vector<std::int64_t> record_times_ms(const TeamLog& log, const RefereeLog* referee);

/// From a START to the STOP, or to the end of the part, that ended it.
struct Play {
  std::int64_t from_ms = 0;  ///< UTC since 1970
  std::int64_t to_ms = 0;
  int part = 1;          ///< 1 to 4, 3 and 4 being overtime
  bool stopped = false;  ///< by a STOP
};

/// What a box's text log says of the game.
struct PlayStatistics {
  std::vector<Play> plays;
  std::vector<double> stop_to_start_s;     ///< from the STOP that ended a play to the next START of the same part
  std::vector<double> restart_to_start_s;  ///< from the last set piece that was called, since the last STOP, to START
  std::int64_t open_plays = 0;             ///< started where the log ends; not among `plays`

  double played_s() const;
  std::int64_t stops() const;

  /// STOPs that ended a play, a minute of play. None: nothing was played.
  std::optional<double> stops_per_min() const;
};

PlayStatistics play_statistics(const RefereeLog& log);

/// The part that the match is in before its first command: by the state that it is logged with, 1 where that says none.
int first_part(const RefereeLog& log);

/// The middle of the values, of an even number the mean of the two in the middle. None: there are none.
std::optional<double> median(std::vector<double> values);

/// The value that `fraction` of the values lie at or below, 0 < fraction <= 1. None: there are none.
std::optional<double> quantile(std::vector<double> values, double fraction);

std::optional<double> mean(const std::vector<double>& values);

/// A robot had the ball.
struct Possession {
  int robot_id = 0;
  std::int64_t from_ms = 0;  ///< UTC since 1970: first and last record that say so
  std::int64_t to_ms = 0;
  std::vector<double> speeds_mps{};  ///< over ground, of the records that have one

  double duration_s() const { return 1e-3 * static_cast<double>(to_ms - from_ms); }
};

/// A contact that is lost for less is the same possession; a shorter possession is none. Both as
/// docs/data/possessions_2016.csv was counted.
inline constexpr std::int64_t kSamePossession_ms = 600, kShortestPossession_ms = 300;

/// Possessions of a team by its robots' `ballEngaged`, in the order of their ends. `times_ms`: of the usable records.
std::vector<Possession> possessions(const TeamLog& log, const std::vector<std::int64_t>& times_ms);

}  // namespace trivela::evaluator::imports
