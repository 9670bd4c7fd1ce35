#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "evaluator/log/reader.hpp"

namespace trivela::evaluator {

/// A possession by a robot's own count, and an instant in it.
struct OwnPossession {
  std::int64_t session_id = 0;
  int robot_id = 0;
  int half = 0;
  std::int64_t number = 0;
  std::optional<std::int64_t> t_ns{};  ///< none: not noted
};

/// The simulator's count of possessions beside the robots' own. The two agree but where a robot takes one for two, or
/// two for one; and each robot of a team counts its own alone.
class TruthCount {
 public:
  /// Of all sessions of a log. Robots of a log before version 6 went by the simulator's count.
  explicit TruthCount(const log::Reader& reader);

  /// Whether the simulator counted in a session.
  bool has(std::int64_t session_id) const { return sessions_.contains(session_id); }

  /// The number of the simulator's possession that lasted at that instant. The robot's own, where the simulator did not
  /// count, the instant is not known, or no possession that it counted ended later.
  std::int64_t number(const OwnPossession& own) const;

 private:
  using Key = std::tuple<std::int64_t, int, int>;     // session, robot, half
  using End = std::pair<std::int64_t, std::int64_t>;  // its instant, number of the possession
  std::map<Key, std::vector<End>> ends_;              // in the order of time
  std::set<std::int64_t> sessions_;
  bool one_count_;
};

}  // namespace trivela::evaluator
