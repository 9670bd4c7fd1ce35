#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "log/file/log_file.hpp"
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

/// Counts the rows of a session that has ended into the tables of kTallies, in place of what they have of it. Its
/// digest must stand in `digests`: it says which rows were counted. Nothing is counted of a match of an experiment,
/// whose log has few rows beside those that would count them. Throws SQLite::Exception.
void write_tallies(SQLite::Database& database, std::int64_t session_id);

/// Creates the views of a connection by which a log is read: what was counted of sessions when they ended, and of all
/// others what is counted now. Throws SQLite::Exception.
void create_tally_views(SQLite::Database& database);

/// Sentences on sessions whose tallies are not those of their rows; of a log whose views are those of
/// create_reading_views(). Throws std::runtime_error where it cannot be read.
std::vector<std::string> wrong_tallies(const LogFile& file);

}  // namespace trivela::log
