#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "evaluator/sessions/session_facts.hpp"

namespace trivela::evaluator {

/// A session as counting needs it.
struct ComparedSession {
  std::int64_t session_id = 0;
  std::int64_t started_utc_ns = 0;
  std::optional<std::int64_t> closed_utc_ns;
  std::int64_t ended_utc_ns = 0;  ///< of the last row, where it was never closed
  std::optional<std::int64_t> seed;
  std::string scenario;
  bool simulated = false;
  bool lockstep = false;  ///< its clock is the simulator's, and the same seed gives the same rows
  std::string uuid;
  std::string continues_uuid;  ///< empty: none
  bool imported = false;       ///< no robot recorded it: two of them are never of one play
  bool is_replay = false;      ///< of another session: what its kicks would have become nobody knows
  bool paired_halves = false;  ///< each half has the possessions of the first
  std::int64_t row_count = 0;  ///< that its recorder wrote; of an experiment its possessions
  std::string arm;             ///< empty: none
  std::string table;           ///< empty: none
  std::optional<std::int64_t> match_id;
  std::optional<std::int64_t> calibration_id;
  std::string config_sha256;
  SessionSetup setup;
  std::uint32_t log = 0;    ///< place of the log that it is read from
  std::uint32_t match = 0;  ///< number of its match over all logs, from 0
  std::uint32_t play = 0;   ///< recordings of one play have the same number: what they have alike is one thing
  bool counts = true;       ///< false: a replay, or a match that another session has, played again
  std::map<int, std::string> in_charge;  ///< the policies of each half, where the session says them
  std::set<int> halves_left_out;         ///< that another session has, played again
};

/// A kick as one recording has it.
struct KickRecording {
  std::uint32_t session = 0;  ///< place in the sessions
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;    ///< of the decision, in the clock of whoever decided
  std::int64_t utc_ns = 0;  ///< the same by the recorder's clock
  int words = 0;  ///< 0: decided; 1: with a receipt; 2: refused, or with an outcome; 3: with one that is known
  int half = 0;
  std::int64_t labelled_utc_ns = 0;  ///< of the label by hand that holds; 0: none

  /// The same kick, whoever recorded it.
  auto kick() const { return std::tuple(robot_id, kick_id, t_ns); }
};

/// Finds out which sessions recorded the same play and sets `play` and `counts`:
/// - sessions with a kick in common, by robot, kick_id and instant, recorded the same play;
/// - so did a session and the one that it goes on from, and sessions of robots that overlap in time, unless both have
///   kicks of one robot from the time that they share and none of them is the same;
/// - matches of the same seed, arm, table and configuration played twice in lockstep have the same rows: the more
///   complete one counts; so does a half of one, where its seed, world, settings and policies are those of a half of
///   another match and something else differs: its length, or who was in charge of the other half;
/// - a replay does not count, except where there is nothing else.
/// An experiment's sessions (match_id) are nobody else's recordings.
void find_plays(std::vector<ComparedSession>& sessions, const std::vector<KickRecording>& kicks);

/// Places in `kicks` of those that do not count: of sessions that do not, and of a kick that several recordings of a
/// play have all but the one with the latest label by hand, else the one that says most, the more complete recording's
/// where they say as much.
std::vector<std::size_t> kicks_left_out(const std::vector<ComparedSession>& sessions,
                                        const std::vector<KickRecording>& kicks);

}  // namespace trivela::evaluator
