#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>
#include <vector>

#include "log/file/log_file.hpp"

namespace trivela::log {

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
