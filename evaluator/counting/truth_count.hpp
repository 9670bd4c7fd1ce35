#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_set>

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

}  // namespace trivela::evaluator
