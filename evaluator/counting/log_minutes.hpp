#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// The simulator's count of possessions beside the robots' own. The two agree but where a robot takes one for two, or
/// two for one; and each robot of a team counts its own alone. They meet in the first decision of a possession in play,
/// whose instant the log has beside the policy that was in charge.
class TruthCount {
 public:
  /// Of all sessions of a log.
  explicit TruthCount(const log::Reader& reader);

  /// Whether the simulator counted in a session.
  bool has(std::int64_t session_id) const { return sessions_.contains(session_id); }

  /// The simulator's number of a possession that the robot numbers `own`; `own` where the simulator did not count
  /// or the log does not say more.
  std::int64_t number(std::int64_t session_id, int robot_id, int half, std::int64_t own) const;

 private:
  using Possession = std::tuple<std::int64_t, int, int, std::int64_t>;  // session, robot, half, number

  std::unordered_set<std::int64_t> sessions_;
  std::map<Possession, std::int64_t> other_;  // where the two differ
};

/// Play (or session), robot, half, number of the possession.
using PossessionKey = std::tuple<std::uint32_t, int, int, std::int64_t>;

struct PossessionHash {
  std::size_t operator()(const PossessionKey& key) const {
    const auto [play, robot, half, possession] = key;
    std::uint64_t h = (static_cast<std::uint64_t>(play) << 32) ^ static_cast<std::uint64_t>(possession);
    h ^= static_cast<std::uint64_t>(robot * 2 + half) << 56;
    h *= 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// Place of a possession in the rows: of all recordings of a play one.
using PossessionPlaces = std::unordered_map<PossessionKey, std::size_t, PossessionHash>;

/// Play of a possession as one recording heard it from one robot's referee.
struct RecordedSpan {
  std::uint32_t session = 0;
  int of_robot = 0;  ///< that counts its own possessions; 0: the referee counts them, for all
  int half = 0;
  std::int64_t possession_id = 0;
  std::int64_t from_ns = 0;  ///< by UTC, in lockstep by the simulator's clock
  std::int64_t to_ns = 0;
  std::int64_t played_ns = 0;
};

/// The policies that a session says were in charge of its halves.
struct PolicyOfHalf {
  std::uint32_t session = 0;
  int half = 0;
  PolicyOfRobot who;  ///< robot 0: each that has none of its own
};

/// What logs say of play and of who was in charge of it.
struct RecordedPlay {
  std::vector<RecordedSpan> spans;
  std::vector<PolicyOfHalf> policies;
};

/// Adds what a log says of these sessions. Possessions that `truths` knows go by the simulator's count.
void read_play(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths,
               RecordedPlay& received);

/// Minutes of play of each possession, once, however many recordings and robots heard the referee: the time that any of
/// them covers. `logged` has the sessions and the opportunities, whose robots had the ball. A possession that nobody is
/// known to have had is of the policy of its half, where all robots of the session have the same one.
std::vector<PlayedSpan> played_spans(const RecordedPlay& received, const LoggedOpportunities& logged);

}  // namespace trivela::evaluator
