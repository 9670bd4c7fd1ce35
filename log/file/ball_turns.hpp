#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "log/schema/queries.hpp"

namespace trivela::log {

/// How far forward the ball came, in F [m], where the flight camera saw it come back after a kick: by more than 0.4 m
/// both ways, within 3 s. Of the sessions that `wanted`, a SELECT, names, in the order of session and time.
struct BallTurn {
  std::int64_t session_id = 0;
  double y_m = 0.0;
};
std::vector<BallTurn> ball_turns(const Queries& rows, std::string_view wanted);

/// Of all sessions of a log that is being read: as they were counted when they ended, else counted now.
std::vector<double> ball_turns_of(const Queries& reader);

}  // namespace trivela::log
